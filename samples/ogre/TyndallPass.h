// Tyndall as a pass of OGRE's compositors: TyndallPass.h and TyndallPass.cpp are what a game copies.
//
//     compositorManager.registerCustomCompositionPass("tyndall", &pass);
//
//     texture scene target_width target_height PF_FLOAT16_RGBA PF_DEPTH32F no_fsaa depth_pool 0
//     target scene
//     {
//       ...
//       pass render_custom tyndall
//       {
//         input 0 scene 0 // colour
//         input 1 scene 1 // depth
//       }
//     }
#pragma once

#include <Ogre.h>
#include <OgreCustomCompositionPass.h>
#include <tyndall/tyndall.h>

#include <map>

/// Lights, their shadow textures, the camera and what moves are those of OGRE's scene. Shadow textures have a depth
/// format (PF_DEPTH32F), those of one light one size.
class TyndallPass final : public Ogre::CustomCompositionPass {
public:
  /// With OGRE's GL context current, OpenGL 4.3. Throws an Ogre::Exception if Tyndall cannot work in it.
  explicit TyndallPass(tyndall::GlLoader loader);

  bool enabled = true;
  tyndall::Medium medium;
  tyndall::Settings settings;
  bool reuse = true;                           ///< of the viewport's last picture, as long as its camera stands still
  std::function<void(tyndall::Frame&)> adjust; ///< a last look at a frame before it is drawn

  Ogre::CompositorInstance::RenderSystemOperation* createOperation(Ogre::CompositorInstance* instance,
                                                                   const Ogre::CompositionPass* pass) override;

  tyndall::Effect& effect() { return *effect_; }

private:
  /// What a viewport showed last.
  struct Eye {
    std::uint64_t name = 0, frame = 0;
    std::map<Ogre::String, tyndall::Mat4> places; ///< of a box around each entity
  };
  struct Operation;
  using Copy = void (*)(unsigned, unsigned, int, int, int, int, unsigned, unsigned, int, int, int, int, int, int, int);

  void render(Ogre::SceneManager& scene, const Ogre::Camera& camera, const Ogre::Texture& colour,
              const Ogre::Texture& depth, Eye& eye);
  void addLights(Ogre::SceneManager& scene, tyndall::Frame& frame);
  void addShadow(Ogre::SceneManager& scene, std::size_t first, std::size_t count, tyndall::ShadowMap& shadow);

  std::unique_ptr<tyndall::Effect> effect_;
  Copy copy_ = nullptr;                            ///< glCopyImageSubData
  std::map<std::size_t, Ogre::TexturePtr> arrays_; ///< by a light's first shadow texture: all its cascades
  tyndall::Status status_;                         ///< of the last frame
  std::uint64_t eyes_ = 0;
};
