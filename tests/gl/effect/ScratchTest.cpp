#include "SceneRig.h"
#include "reference/Metrics.h"
#include "reference/CameraRays.h"
#include <catch2/catch.hpp>
#include <iostream>
#include <glm/gtc/matrix_transform.hpp>
using namespace tyndall;
TEST_CASE("scratch") {
    tests::SceneRig rig;
    rig.addLight(LightKind::Point);
    tests::DepthConvention c; c.orthographic = true; c.reversed = true;
    rig.setConvention(c);
    auto a = rig.render(), b = rig.reference();
    double mean = reference::compare(a.inscatter, b.inscatter).mean;
    for (int y=0;y<16;++y) for (int x=0;x<24;++x) { double d = std::abs(a.inscatter.at(x,y).x-b.inscatter.at(x,y).x)/mean; if (d>1e-5) std::cout << x << " " << y << " " << d << " " << a.inscatter.at(x,y).x << " " << b.inscatter.at(x,y).x << " dist " << rig.distances[y*24+x] << "\n"; }
    Camera cam = rig.frame.camera;
    for (double e : {-1e-5,-1e-6,-1e-7,1e-7,1e-6,1e-5}) for (int ax=0;ax<2;++ax) {
      rig.frame.camera = cam; rig.frame.camera.viewFromWorld[12+ax] += e;
      auto r = rig.reference(); auto m = reference::compare(r.inscatter, b.inscatter);
      std::cout << e << " " << ax << " " << m.text() << "\n";
    }
}
