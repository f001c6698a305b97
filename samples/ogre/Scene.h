// A hall of OGRE's with holes in its roof, a sun through them, a lamp behind a wheel, and things that move.
#pragma once

#include <Ogre.h>

/// Its shadows are OGRE's own: three cascades for the sun (PSSM), one map for the lamp, depth textures all.
class Scene {
public:
  explicit Scene(Ogre::Root& root);

  Ogre::SceneManager& manager() { return *manager_; }
  /// A camera; each sees the hall from another place.
  Ogre::Camera* addCamera(int index);
  void moveTo(double seconds);

private:
  Ogre::SceneNode* addBox(const char* material, const Ogre::Vector3& centre, const Ogre::Vector3& size,
                          Ogre::SceneNode* parent = nullptr);
  void addShadows();
  void addHall();
  void addLights();
  void addMovers();

  Ogre::SceneManager* manager_;
  Ogre::SceneNode* fan_ = nullptr;
  Ogre::SceneNode* pendulum_ = nullptr;
  Ogre::SceneNode* wheel_ = nullptr;
  Ogre::Quaternion wheelAxis_;
};
