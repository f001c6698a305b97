#include "TyndallPass.h"

namespace {

constexpr unsigned kTexture2D = 0x0DE1, kTexture2DArray = 0x8C1A;

template <typename Matrix>
tyndall::Mat4 mat4(const Matrix& matrix) {
  return tyndall::mat4RowMajor(matrix[0]);
}
tyndall::Vec3 vec3(const Ogre::Vector3& v) { return {v.x, v.y, v.z}; }

unsigned nameOf(const Ogre::Texture& texture) {
  return const_cast<Ogre::Texture&>(texture).getCustomAttribute("GLID"); // which does not change it
}

/// OGRE draws into textures with row 0 at the top.
Ogre::Matrix4 clipFromView(const Ogre::Frustum& frustum) {
  Ogre::Matrix4 matrix = frustum.getProjectionMatrixWithRSDepth();
  for (int column = 0; column < 4; ++column)
    matrix[1][column] = -matrix[1][column];
  return matrix;
}

tyndall::ClipDepth clipDepth() {
  const bool reversed = Ogre::Root::getSingleton().getRenderSystem()->isReverseDepthBufferEnabled();
  return reversed ? tyndall::ClipDepth::ZeroToOne : tyndall::ClipDepth::NegativeOneToOne;
}

tyndall::Light lightOf(const Ogre::Light& from) {
  tyndall::Light light;
  const Ogre::ColourValue colour = from.getDiffuseColour() * from.getPowerScale();
  light.colour = {colour.r, colour.g, colour.b};
  light.direction = vec3(from.getDerivedDirection());
  if (from.getType() == Ogre::Light::LT_DIRECTIONAL) return light;
  light.kind = from.getType() == Ogre::Light::LT_POINT ? tyndall::LightKind::Point : tyndall::LightKind::Spot;
  light.position = vec3(from.getDerivedPosition());
  light.range = from.getAttenuationRange();
  light.innerConeAngle = from.getSpotlightInnerAngle().valueRadians() / 2; // OGRE's are whole angles
  light.outerConeAngle = from.getSpotlightOuterAngle().valueRadians() / 2;
  return light;
}

/// What has moved, appeared or vanished since the eye's last frame.
std::vector<tyndall::MovingObject> movedObjects(Ogre::SceneManager& scene,
                                                std::map<Ogre::String, tyndall::Mat4>& places) {
  std::map<Ogre::String, tyndall::Mat4> last;
  std::swap(last, places);
  std::vector<tyndall::MovingObject> moved;
  for (const auto& [name, object] : scene.getMovableObjects("Entity")) {
    const Ogre::AxisAlignedBox& box = object->getBoundingBox();
    if (!object->isInScene() || !object->isVisible() || !box.isFinite()) continue;
    const Ogre::Affine3 boxPlace =
        Ogre::Affine3::getTrans(box.getCenter()) * Ogre::Affine3::getScale(box.getHalfSize() + Ogre::Vector3(1e-4F));
    const tyndall::Mat4 place = mat4(object->_getParentNodeFullTransform() * boxPlace);
    places[name] = place;
    const auto known = last.find(name);
    if (known == last.end() || known->second != place)
      moved.push_back({place, known == last.end() ? place : known->second});
    if (known != last.end()) last.erase(known);
  }
  for (const auto& [name, place] : last)
    moved.push_back({place, place});
  return moved;
}

} // namespace

/// One for each viewport; OGRE makes a new one when the viewport's size changes.
struct TyndallPass::Operation final : Ogre::CompositorInstance::RenderSystemOperation {
  TyndallPass& pass;
  Ogre::CompositorInstance& instance;
  const Ogre::CompositionPass::InputTex colour, depth;
  Eye eye;

  Operation(TyndallPass& tyndallPass, Ogre::CompositorInstance& of, const Ogre::CompositionPass& compositionPass)
      : pass(tyndallPass), instance(of), colour(compositionPass.getInput(0)), depth(compositionPass.getInput(1)) {
    eye.name = ++pass.eyes_;
  }
  void execute(Ogre::SceneManager* scene, Ogre::RenderSystem* /*system*/) override {
    pass.render(*scene, *instance.getChain()->getViewport()->getCamera(),
                *instance.getTextureInstance(colour.name, colour.mrtIndex),
                *instance.getTextureInstance(depth.name, depth.mrtIndex), eye);
  }
};

TyndallPass::TyndallPass(tyndall::GlLoader loader) : copy_(reinterpret_cast<Copy>(loader("glCopyImageSubData"))) {
  tyndall::CreateResult created = tyndall::Effect::create({loader});
  effect_ = std::move(created.effect);
  if (!effect_) OGRE_EXCEPT(Ogre::Exception::ERR_RENDERINGAPI_ERROR, created.status.message, "TyndallPass");
}

Ogre::CompositorInstance::RenderSystemOperation* TyndallPass::createOperation(Ogre::CompositorInstance* instance,
                                                                              const Ogre::CompositionPass* pass) {
  return OGRE_NEW Operation(*this, *instance, *pass);
}

void TyndallPass::render(Ogre::SceneManager& scene, const Ogre::Camera& camera, const Ogre::Texture& colour,
                         const Ogre::Texture& depth, Eye& eye) {
  if (!enabled) return;
  tyndall::Frame frame;
  frame.viewport = {0, 0, static_cast<int>(colour.getWidth()), static_cast<int>(colour.getHeight())};
  frame.colour = nameOf(colour);
  frame.depth.texture = nameOf(depth);
  frame.camera = {mat4(camera.getViewMatrix(true)), mat4(clipFromView(camera)), clipDepth()};
  frame.medium = medium;
  frame.settings = settings;
  addLights(scene, frame);
  if (reuse) {
    frame.reuse.changes = tyndall::Changes::Objects;
    frame.reuse.eye = eye.name;
    frame.reuse.frame = ++eye.frame;
    frame.objects = movedObjects(scene, eye.places);
  }
  if (adjust) adjust(frame);
  tyndall::Status status = effect_->render(frame);
  if (status.message != status_.message) Ogre::LogManager::getSingleton().logError("Tyndall: " + status.message);
  status_ = std::move(status);
}

void TyndallPass::addLights(Ogre::SceneManager& scene, tyndall::Frame& frame) {
  std::size_t next = 0; // OGRE hands out shadow textures to these lights in this order
  for (const Ogre::Light* from : scene._getLightsAffectingFrustum()) {
    tyndall::Light light = lightOf(*from);
    const std::size_t count = from->getCastShadows() ? scene.getShadowTextureCountPerLightType(from->getType()) : 0;
    if (count > 0 && next + count <= scene.getShadowTextureConfigList().size()) {
      addShadow(scene, next, count, light.shadow);
      next += count;
    }
    frame.lights.push_back(light);
  }
}

/// OGRE's cascades are textures of their own, Tyndall's layers of one: they are copied.
void TyndallPass::addShadow(Ogre::SceneManager& scene, std::size_t first, std::size_t count,
                            tyndall::ShadowMap& shadow) {
  Ogre::TexturePtr texture = scene.getShadowTexture(first);
  const int width = static_cast<int>(texture->getWidth()), height = static_cast<int>(texture->getHeight());
  if (count > 1) {
    Ogre::TexturePtr& array = arrays_[first];
    if (!array || array->getWidth() != texture->getWidth() || array->getDepth() != count)
      array = Ogre::TextureManager::getSingleton().createManual(
          "tyndall/cascades" + std::to_string(first), Ogre::RGN_INTERNAL, Ogre::TEX_TYPE_2D_ARRAY, texture->getWidth(),
          texture->getHeight(), static_cast<Ogre::uint>(count), 0, texture->getFormat());
    texture = array;
  }
  shadow.texture = nameOf(*texture);
  shadow.array = count > 1;
  shadow.clipDepth = clipDepth();
  for (std::size_t i = 0; i < count; ++i) {
    const Ogre::TexturePtr& view = scene.getShadowTexture(first + i);
    const Ogre::Camera& camera = *view->getBuffer()->getRenderTarget()->getViewport(0)->getCamera();
    shadow.views.push_back({mat4(clipFromView(camera) * camera.getViewMatrix(true)), static_cast<int>(i)});
    if (count > 1)
      copy_(nameOf(*view), kTexture2D, 0, 0, 0, 0, shadow.texture, kTexture2DArray, 0, 0, 0, static_cast<int>(i), width,
            height, 1);
  }
}
