// A scene as a state asks for it: maps, surfaces, and the frame that the effect is given.
#pragma once

#include "VolumeShadows.h"

#include <cstdint>
#include <gl/Context.h>
#include <gl/FogVolumes.h>
#include <gl/RenderTargets.h>
#include <gl/SceneRenderer.h>
#include <gl/ShadowLayout.h>
#include <memory>
#include <optional>
#include <scene/Scene.h>
#include <scene/View.h>
#include <settings/State.h>
#include <tyndall/tyndall.h>
#include <vector>

namespace render {

/// How passes are timed: timer queries of a software rasteriser measure when commands were queued, not when they ran.
tyndall::PassTiming timingFor(const host::Context& context);

/// Adds those that are not among them.
void addOnce(host::Notes& notes, const host::Notes& more);

/// What of a state's animation is drawn.
struct Moment {
  double seconds = 0;
  int jitterPlace = 0;               ///< for State::halton: counts frames
  bool isCoarse = false;             ///< planes and shadow views hold boxes around the meshes: not tight, and fast
  std::optional<tyndall::Light> sun; ///< in place of all lights
};

class SceneDrawer {
public:
  /// Uploads the scene in the current context, which outlives this.
  SceneDrawer(host::Scene scene, const host::Context& context, const settings::State& state, host::Notes& notes);

  /// Draws maps and surfaces, and fills in the frame's camera and lights and, by what moved since the last call, its
  /// objects. Its textures live until the next call. What would be as at the last call is not drawn again. Throws
  /// host::Error.
  void draw(const settings::State& state, const Moment& moment, host::RenderTargets& surfaces, tyndall::Frame& frame,
            host::Notes& notes);

  /// The surfaces are to be drawn, whatever the targets hold.
  void forgetSurfaces() { surfacesKey_.clear(); }

  /// The state's medium, or the scene's.
  tyndall::Medium mediumOf(const settings::State& state, host::Notes& notes) const;

  /// The state's ambient light, or the scene's; none if neither has any.
  tyndall::Ambient ambientOf(const settings::State& state) const;

  /// The scene's banks of fog as the state fills them, and what they scatter.
  settings::StateFog fogOf(const settings::State& state) const;
  /// Whether the effect lights fog, or smoke, in such a state.
  bool lightsFog(const settings::State& state) const;

  /// Of the scene, or of boxes().
  static tyndall::Camera cameraOf(const host::Scene& scene, const settings::State& state,
                                  const std::vector<glm::dmat4>& worldFromNode, host::Notes& notes);

  /// Shadow and glass maps of more bytes are refused.
  std::uint64_t mostMapBytes = ~0ULL;

  const host::Scene& scene() const { return scene_; }
  const host::Scene& boxes() const { return boxes_; }           ///< host::boxesOf(scene())
  bool hasVolumes() const;                                      ///< smoke, fog or strands
  const std::vector<glm::dmat4>& pose() const { return pose_; } ///< of the last draw(); empty before the first
  const VolumeShadows* volumeShadows() const { return volumeShadows_.get(); } ///< null: there are none

private:
  std::vector<tyndall::Light> lightsOf(const settings::State& state, const Moment& moment,
                                       const std::vector<glm::dmat4>& worldFromNode, host::Notes& notes) const;
  glm::vec3 skyOf(const Moment& moment, const std::vector<glm::dmat4>& worldFromNode,
                  const std::vector<tyndall::Light>& lights, host::Notes& notes);
  const host::Scene& fittedTo(const Moment& moment) const { return moment.isCoarse ? boxes_ : scene_; }
  void fitViews(const settings::State& state, const Moment& moment, const std::vector<glm::dmat4>& worldFromNode,
                tyndall::Frame& frame, host::Notes& notes) const;
  /// A light with its maps as they were drawn.
  struct MappedLight {
    std::vector<double> cause; ///< what they show
    std::vector<double> views; ///< how: the matrices
    int size = 0;              ///< texels per side
    host::ShadowMapTextures textures;
    tyndall::Light light;
  };
  static bool isMapped(const MappedLight& last, const MappedLight& now, const Moment& moment);
  std::vector<double> volumesKeyOf(const settings::State& state, const Moment& moment,
                                   const std::vector<glm::dmat4>& worldFromNode) const;
  void drawVolumes(const settings::State& state, const Moment& moment, const std::vector<glm::dmat4>& worldFromNode,
                   tyndall::Frame& frame);
  void checkMapBytes(const settings::State& state, const tyndall::Frame& frame) const;
  void setVolumes(const settings::State& state, const Moment& moment, const std::vector<glm::dmat4>& worldFromNode);
  void drawMaps(const settings::State& state, const Moment& moment, const std::vector<glm::dmat4>& worldFromNode,
                tyndall::Frame& frame);
  void drawSurfaces(const std::vector<glm::dmat4>& worldFromNode, const glm::vec3& sky, host::RenderTargets& surfaces,
                    const tyndall::Frame& frame);
  void layOutMaps(const settings::State& state, tyndall::Frame& frame);
  void makeVolumeShadows(const settings::State& state, host::Notes& notes);
  void seeThroughVolumes(const settings::State& state, const Moment& moment,
                         const std::vector<glm::dmat4>& worldFromNode, const host::RenderTargets& image,
                         tyndall::Frame& frame);
  std::vector<tyndall::MovingObject> movedObjects(const std::vector<glm::dmat4>& worldFromNode, double seconds) const;

  /// Of smoke's shadows, as State has them.
  struct Avsm {
    bool isOn = false;
    int size = 0, nodes = 0;
  };

  const host::Context& context_;
  host::Scene scene_, boxes_;
  std::unique_ptr<host::SceneRenderer> renderer_;
  std::unique_ptr<host::ShadowLayout> shadowLayout_; ///< none: the maps are the effect's as they are
  host::MapForm mapForm_;                            ///< of shadowLayout_
  std::vector<host::LaidOutMaps> laidOutMaps_;
  std::vector<double> skyKey_, volumesKey_, surfacesKey_; ///< all that they were made of; empty: nothing was
  glm::vec3 sky_{0};
  host::Notes skyNotes_;
  std::vector<MappedLight> mapped_;         ///< of the last frame
  std::vector<tyndall::AvsmCurves> curves_; ///< of its lights
  std::vector<double> eyeKey_;              ///< what eyeCurves_ was made of
  tyndall::EyeCurves eyeCurves_;
  std::optional<host::FogVolumes> fog_;          ///< of a scene that has banks of it
  std::unique_ptr<VolumeShadows> volumeShadows_; ///< none without smoke, fog and strands, or where they cast no shadow
  Avsm avsm_;                                    ///< that they were made with
  std::vector<host::Bounds> meshBounds_;
  std::vector<glm::dmat4> pose_;
  double seconds_ = 0; ///< of the pose
};

} // namespace render
