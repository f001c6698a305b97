// Unshadowed light against closed forms and adaptive quadrature: every light, every phase function, extinction from 0
// to 100 and distances from 1e-2 to 1e5.
#include "AirlightSweep.h"
#include "support/Catch.h"

using namespace tyndall;
using tests::AirlightSweep;
using tests::errorOf;
using tests::mediumOf;

namespace {

const std::vector<Constituent> kConstituents = {{{}, Phase::Isotropic, 0},
                                                {{}, Phase::Rayleigh, 0},
                                                {{}, Phase::HenyeyGreenstein, 0.6F},
                                                {{}, Phase::HenyeyGreenstein, -0.5F},
                                                {{}, Phase::HenyeyGreenstein, 0.95F},
                                                {{}, Phase::CornetteShanks, 0.76F}};

} // namespace

TEST_CASE("unshadowed directional light equals its closed form", "[sweep]") {
  for (const Constituent& c : kConstituents)
    for (const Vec3& direction : {Vec3{0, -1, 0}, Vec3{0.3, -0.2, 1}, Vec3{-0.1, -0.05, -1}, Vec3{-0.35, -0.13, 3}}) {
      AirlightSweep sweep{{}, mediumOf(c)};
      sweep.light.direction = direction;
      sweep.light.colour = {3, 2, 1};
      CAPTURE(static_cast<int>(c.phase), c.g, direction[0], direction[2]);
      CHECK(errorOf(sweep) <= 1e-5);
    }
}

TEST_CASE("a directional light in a bounded medium equals its closed form") {
  for (const Vec3& normal : {Vec3{0, 1, 0}, Vec3{0.2, 1, -0.4}, Vec3{0.3, 1, 1}}) {
    AirlightSweep sweep{{}, mediumOf(kConstituents[2])};
    sweep.light.direction = {0.3, -1, 0.4};
    sweep.light.boundary = {true, {0, 2.2, 0}, normal};
    CAPTURE(normal[0], normal[1], normal[2]);
    CHECK(errorOf(sweep) <= 1e-5);
  }
}

TEST_CASE("unshadowed point light equals adaptive quadrature", "[sweep]") {
  for (const Constituent& c : kConstituents)
    for (const Vec3& position :
         {Vec3{1, 3, 1}, Vec3{-20, 5, -300}, Vec3{1.05, 2.01, 2.9}, Vec3{0.5, 1.5, 30}, Vec3{2e4, 1e4, -7e4}}) {
      AirlightSweep sweep{{}, mediumOf(c)};
      sweep.light.kind = LightKind::Point;
      sweep.light.position = position;
      CAPTURE(static_cast<int>(c.phase), c.g, position[0], position[2]);
      CHECK(errorOf(sweep) <= 1e-4);
    }
}

TEST_CASE("unshadowed spot light equals adaptive quadrature", "[sweep]") {
  for (const Constituent& c : kConstituents)
    for (const double outer : {0.05, 0.6, 1.5707963267948966})
      for (const double inner : {0.0, 0.7, 1.0}) {
        AirlightSweep sweep{{}, mediumOf(c)};
        sweep.light.kind = LightKind::Spot;
        sweep.light.position = {3, 4, -2};
        sweep.light.direction = {-0.6, -0.55, 0.2};
        sweep.light.outerConeAngle = outer;
        sweep.light.innerConeAngle = inner * outer;
        sweep.light.range = outer > 1 ? 50 : kInfinity;
        CAPTURE(static_cast<int>(c.phase), c.g, outer, inner);
        CHECK(errorOf(sweep) <= 1e-4);
      }
}
