#include "Scene.h"

#include <cmath>

namespace {

constexpr float kNear = 0.3F, kFar = 40;
constexpr int kCascades = 3;

/// A cube from -0.5 to 0.5, as a mesh of the name "box".
void makeBox(Ogre::SceneManager& manager) {
  Ogre::ManualObject* cube = manager.createManualObject();
  cube->begin("Demo/Stone", Ogre::RenderOperation::OT_TRIANGLE_LIST);
  std::uint32_t first = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-0.5F, 0.5F}) {
      Ogre::Vector3 normal = Ogre::Vector3::ZERO, u = normal, v = normal;
      normal[axis] = side;
      u[(axis + 1) % 3] = 0.5F;
      v[(axis + 2) % 3] = side; // so that faces turn the same way
      for (const auto& [s, t] : {std::pair{-1.F, -1.F}, {1.F, -1.F}, {1.F, 1.F}, {-1.F, 1.F}}) {
        cube->position(normal + u * s + v * t);
        cube->normal(normal * 2);
      }
      cube->quad(first, first + 1, first + 2, first + 3);
      first += 4;
    }
  cube->end();
  cube->convertToMesh("box");
  manager.destroyManualObject(cube);
}

} // namespace

Scene::Scene(Ogre::Root& root) : manager_(root.createSceneManager()) {
  makeBox(*manager_);
  manager_->setAmbientLight(Ogre::ColourValue::Black);
  addShadows();
  addHall();
  addLights();
  addMovers();
}

void Scene::addShadows() {
  manager_->setShadowTechnique(Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED);
  manager_->setShadowFarDistance(kFar);
  manager_->setShadowTextureCountPerLightType(Ogre::Light::LT_DIRECTIONAL, kCascades);
  manager_->setShadowTextureSettings(1024, kCascades + 1, Ogre::PF_DEPTH32F);
  manager_->setShadowTextureSelfShadow(true);
  manager_->setShadowCasterRenderBackFaces(false);
  manager_->setShadowTextureCasterMaterial(Ogre::MaterialManager::getSingleton().getByName("Demo/Caster"));

  const auto cascades = std::make_shared<Ogre::PSSMShadowCameraSetup>();
  cascades->calculateSplitPoints(kCascades, kNear, kFar, 0.7F);
  for (int i = 0; i < kCascades; ++i)
    cascades->setOptimalAdjustFactor(i, 0); // even texels, not LiSPSM's
  cascades->setSplitPadding(0.1F);
  manager_->setShadowCameraSetup(cascades);

  Ogre::Vector4f splits(0.F);
  for (int i = 0; i < kCascades; ++i)
    splits[i] = cascades->getSplitPoints()[i + 1];
  for (const char* material : {"Demo/Stone", "Demo/Wood"})
    Ogre::MaterialManager::getSingleton()
        .getByName(material)
        ->getTechnique(0)
        ->getPass(0)
        ->getFragmentProgramParameters()
        ->setNamedConstant("splits", splits);
}

Ogre::SceneNode* Scene::addBox(const char* material, const Ogre::Vector3& centre, const Ogre::Vector3& size,
                               Ogre::SceneNode* parent) {
  Ogre::SceneNode* node = (parent ? parent : manager_->getRootSceneNode())->createChildSceneNode(centre);
  Ogre::Entity* box = manager_->createEntity("box");
  box->setMaterialName(material);
  node->attachObject(box);
  node->setScale(size);
  return node;
}

void Scene::addHall() {
  addBox("Demo/Stone", {0, -0.25F, 0}, {14, 0.5F, 24});   // floor
  addBox("Demo/Stone", {0, 3.5F, -12}, {14, 7.5F, 0.5F}); // far wall
  addBox("Demo/Stone", {-7, 3.5F, 0}, {0.5F, 7.5F, 24});  // side walls
  addBox("Demo/Stone", {7, 3.5F, 0}, {0.5F, 7.5F, 24});
  for (int i = -3; i <= 3; ++i) { // roof: beams both ways
    addBox("Demo/Stone", {2 * float(i), 7, 0}, {1.3F, 0.3F, 24});
    addBox("Demo/Stone", {0, 7.1F, 3.6F * float(i)}, {14, 0.3F, 2.4F});
  }
  for (int i = -2; i <= 2; ++i) // columns
    for (const float x : {-5.F, 5.F})
      addBox("Demo/Stone", {x, 3.5F, 4.5F * float(i)}, {0.7F, 7, 0.7F});
}

void Scene::addLights() {
  Ogre::Light* sun = manager_->createLight();
  sun->setType(Ogre::Light::LT_DIRECTIONAL);
  sun->setDiffuseColour(26, 21, 15);
  Ogre::SceneNode* sunNode = manager_->getRootSceneNode()->createChildSceneNode();
  sunNode->setDirection(Ogre::Vector3(0.35F, -1, 0.45F), Ogre::Node::TS_WORLD);
  sunNode->attachObject(sun);

  Ogre::Light* lamp = manager_->createLight();
  lamp->setType(Ogre::Light::LT_SPOTLIGHT);
  lamp->setDiffuseColour(100, 150, 260);
  lamp->setSpotlightRange(Ogre::Degree(40), Ogre::Degree(50));
  lamp->setSpotlightNearClipDistance(0.2F);
  lamp->setAttenuation(30, 0, 0, 1);
  lamp->setShadowNearClipDistance(0.2F);
  lamp->setShadowFarClipDistance(30);
  // PSSM's setup would show a spot no more than the first split.
  lamp->setCustomShadowCameraSetup(std::make_shared<Ogre::DefaultShadowCameraSetup>());
  Ogre::SceneNode* lampNode = manager_->getRootSceneNode()->createChildSceneNode(Ogre::Vector3(-4.5F, 3.2F, -8));
  lampNode->setDirection(Ogre::Vector3(1, -0.15F, 0.45F), Ogre::Node::TS_WORLD);
  lampNode->attachObject(lamp);
}

void Scene::addMovers() {
  Ogre::SceneNode* root = manager_->getRootSceneNode();
  fan_ = root->createChildSceneNode(Ogre::Vector3(0, 6, -3)); // under the roof
  for (int i = 0; i < 2; ++i)
    addBox("Demo/Wood", Ogre::Vector3::ZERO, i ? Ogre::Vector3(0.5F, 0.1F, 5) : Ogre::Vector3(5, 0.1F, 0.5F), fan_);

  pendulum_ = root->createChildSceneNode(Ogre::Vector3(2.5F, 6.8F, 1));
  addBox("Demo/Wood", {0, -2.4F, 0}, {0.08F, 4.8F, 0.08F}, pendulum_);
  addBox("Demo/Wood", {0, -5, 0}, {0.9F, 0.9F, 0.9F}, pendulum_);

  wheel_ = root->createChildSceneNode(Ogre::Vector3(-3.2F, 3, -7.4F)); // before the lamp
  wheel_->setDirection(Ogre::Vector3(1, -0.15F, 0.45F), Ogre::Node::TS_WORLD);
  wheelAxis_ = wheel_->getOrientation();
  for (int i = 0; i < 4; ++i) {
    Ogre::SceneNode* spoke = addBox("Demo/Wood", Ogre::Vector3::ZERO, {1.6F, 0.14F, 0.05F}, wheel_);
    spoke->roll(Ogre::Degree(45 * float(i)));
  }
}

Ogre::Camera* Scene::addCamera(int index) {
  const Ogre::Vector3 eyes[] = {{0.5F, 1.8F, 10.5F}, {-5.8F, 4.5F, 3}}, targets[] = {{0, 3, 0}, {2, 2.2F, -5}};
  Ogre::Camera* camera = manager_->createCamera("camera" + std::to_string(index));
  camera->setNearClipDistance(kNear);
  camera->setFarClipDistance(kFar);
  camera->setAutoAspectRatio(true);
  Ogre::SceneNode* node = manager_->getRootSceneNode()->createChildSceneNode(eyes[index]);
  node->lookAt(targets[index], Ogre::Node::TS_WORLD);
  node->attachObject(camera);
  return camera;
}

void Scene::moveTo(double seconds) {
  const auto t = static_cast<float>(seconds);
  fan_->setOrientation(Ogre::Quaternion(Ogre::Radian(0.7F * t), Ogre::Vector3::UNIT_Y));
  pendulum_->setOrientation(Ogre::Quaternion(Ogre::Radian(0.5F * std::sin(1.5F * t)), Ogre::Vector3::UNIT_Z));
  wheel_->setOrientation(wheelAxis_ * Ogre::Quaternion(Ogre::Radian(0.4F * t), Ogre::Vector3::UNIT_Z));
}
