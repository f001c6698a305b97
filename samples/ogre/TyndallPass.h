// Tyndall as a pass of OGRE's compositors. TyndallPass.h and TyndallPass.cpp are what a game copies; registered by
// CompositorManager::registerCustomCompositionPass("tyndall", &pass), it is used as media/demo.compositor shows.
#pragma once

#include <Ogre.h>
#include <OgreCustomCompositionPass.h>
#include <tyndall/tyndall.h>

/// Lights, their shadow textures, the camera and what moves are those of OGRE's scene. Shadow textures have a depth
/// format (PF_DEPTH32F), and the cascades of a light one size.
class TyndallPass final : public Ogre::CustomCompositionPass {
public:
  /// With OGRE's GL context current: OpenGL 4.3. Throws an Ogre::Exception if Tyndall cannot work in it.
  explicit TyndallPass(tyndall::GlLoader loader);

  bool enabled = true;
  /// Keeps of a viewport's last picture what has not changed, as long as its camera stands still; for scenes in which
  /// nothing but entities casts a shadow that moves.
  bool reuse = true;
  tyndall::Medium medium;
  tyndall::Settings settings;
  std::function<void(tyndall::Frame&)> adjust; ///< a last look at a frame before it is drawn

  tyndall::Effect& effect() { return *effect_; }
  Ogre::CompositorInstance::RenderSystemOperation* createOperation(Ogre::CompositorInstance* instance,
                                                                   const Ogre::CompositionPass* pass) override;

private:
  struct Operation;
  using Copy = void (*)(unsigned, unsigned, int, int, int, int, unsigned, unsigned, int, int, int, int, int, int, int);

  void render(Ogre::SceneManager& scene, Operation& operation);
  void addShadow(Ogre::SceneManager& scene, std::size_t first, std::size_t count, tyndall::ShadowMap& shadow);

  std::unique_ptr<tyndall::Effect> effect_;
  Copy copyImage_;                                   ///< glCopyImageSubData
  std::map<std::size_t, Ogre::TexturePtr> cascades_; ///< as layers of one, by the first
  Ogre::String message_;                             ///< of the last frame: logged when it changes
  std::uint64_t eyes_ = 0;
};
