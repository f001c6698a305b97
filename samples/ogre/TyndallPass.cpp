#include "TyndallPass.h"

namespace {

/// A box around an entity.
struct Place {
  tyndall::Mat4 worldFromBox;
  bool deforms; ///< within the box, by a skeleton or vertex animation
};
using Places = std::map<Ogre::String, Place>;

constexpr unsigned kTexture2D = 0x0DE1, kTexture2DArray = 0x8C1A; // GL's names

tyndall::Mat4 mat4(const Ogre::Matrix4& matrix) { return tyndall::mat4RowMajor(matrix[0]); }
unsigned nameOf(const Ogre::TexturePtr& texture) { return texture->getCustomAttribute("GLID"); }

/// As drawn into a texture, which OGRE does with row 0 at the top.
Ogre::Matrix4 clipFromView(const Ogre::Frustum& frustum) {
  return Ogre::Matrix4(Ogre::Affine3::getScale(1, -1, 1)) * frustum.getProjectionMatrixWithRSDepth();
}

tyndall::ClipDepth clipDepth() {
  const bool reversed = Ogre::Root::getSingleton().getRenderSystem()->isReverseDepthBufferEnabled();
  return reversed ? tyndall::ClipDepth::ZeroToOne : tyndall::ClipDepth::NegativeOneToOne;
}

tyndall::Light lightOf(const Ogre::Light& from) {
  tyndall::Light light;
  const Ogre::ColourValue colour = from.getDiffuseColour() * from.getPowerScale();
  light.colour = {colour.r, colour.g, colour.b};
  light.direction = tyndall::vec3(from.getDerivedDirection());
  if (from.getType() == Ogre::Light::LT_DIRECTIONAL) return light;
  light.kind = from.getType() == Ogre::Light::LT_POINT ? tyndall::LightKind::Point : tyndall::LightKind::Spot;
  light.position = tyndall::vec3(from.getDerivedPosition());
  light.range = from.getAttenuationRange();
  light.innerConeAngle = from.getSpotlightInnerAngle().valueRadians() / 2; // OGRE's are whole angles
  light.outerConeAngle = from.getSpotlightOuterAngle().valueRadians() / 2;
  return light;
}

Places placesOf(Ogre::SceneManager& scene) {
  Places places;
  for (const auto& [name, object] : scene.getMovableObjects("Entity")) {
    const Ogre::AxisAlignedBox& box = object->getBoundingBox();
    if (!object->isInScene() || !object->isVisible() || !box.isFinite()) continue;
    const Ogre::Vector3 halfSize = box.getHalfSize() + Ogre::Vector3(1e-4F); // which a flat one has not
    const Ogre::Affine3 cube = Ogre::Affine3::getTrans(box.getCenter()) * Ogre::Affine3::getScale(halfSize);
    const auto& entity = static_cast<const Ogre::Entity&>(*object);
    places[name] = {mat4(entity._getParentNodeFullTransform() * cube),
                    entity.hasSkeleton() || entity.hasVertexAnimation()};
  }
  return places;
}

/// What has moved, appeared or vanished.
std::vector<tyndall::MovingObject> movedObjects(const Places& last, const Places& now) {
  std::vector<tyndall::MovingObject> moved;
  for (const auto& [name, place] : now) {
    const auto known = last.find(name);
    const tyndall::Mat4& before = known == last.end() ? place.worldFromBox : known->second.worldFromBox;
    if (known == last.end() || place.deforms || before != place.worldFromBox)
      moved.push_back({place.worldFromBox, before});
  }
  for (const auto& [name, place] : last)
    if (now.count(name) == 0) moved.push_back({place.worldFromBox, place.worldFromBox});
  return moved;
}

} // namespace

/// Of one viewport; OGRE makes another when its size changes.
struct TyndallPass::Operation final : Ogre::CompositorInstance::RenderSystemOperation {
  TyndallPass& tyndallPass;
  Ogre::CompositorInstance& instance;
  const Ogre::CompositionPass& pass;
  const std::uint64_t eye;
  std::uint64_t frame = 0;
  Places places; ///< in the last frame

  Operation(TyndallPass& t, Ogre::CompositorInstance& i, const Ogre::CompositionPass& p)
      : tyndallPass(t), instance(i), pass(p), eye(++t.eyes_) {}
  void execute(Ogre::SceneManager* scene, Ogre::RenderSystem* /*system*/) override {
    if (tyndallPass.enabled) tyndallPass.render(*scene, *this);
  }
  const Ogre::TexturePtr& input(std::size_t i) {
    return instance.getTextureInstance(pass.getInput(i).name, pass.getInput(i).mrtIndex);
  }
};

TyndallPass::TyndallPass(tyndall::GlLoader loader) : copyImage_(reinterpret_cast<Copy>(loader("glCopyImageSubData"))) {
  tyndall::CreateResult created = tyndall::Effect::create({loader});
  effect_ = std::move(created.effect);
  if (!effect_) OGRE_EXCEPT(Ogre::Exception::ERR_RENDERINGAPI_ERROR, created.status.message, "TyndallPass");
}

Ogre::CompositorInstance::RenderSystemOperation* TyndallPass::createOperation(Ogre::CompositorInstance* instance,
                                                                              const Ogre::CompositionPass* pass) {
  return OGRE_NEW Operation(*this, *instance, *pass);
}

void TyndallPass::render(Ogre::SceneManager& scene, Operation& operation) {
  const Ogre::Camera& camera = *operation.instance.getChain()->getViewport()->getCamera();
  const Ogre::TexturePtr& colour = operation.input(0);
  tyndall::Frame frame;
  frame.viewport = {0, 0, static_cast<int>(colour->getWidth()), static_cast<int>(colour->getHeight())};
  frame.colour = nameOf(colour);
  frame.depth.texture = nameOf(operation.input(1));
  frame.camera = {mat4(camera.getViewMatrix(true)), mat4(clipFromView(camera)), clipDepth()};
  frame.medium = medium;
  frame.settings = settings;
  std::size_t next = 0; // OGRE hands out shadow textures to these lights in this order
  for (const Ogre::Light* light : scene._getLightsAffectingFrustum()) {
    frame.lights.push_back(lightOf(*light));
    const auto count = light->getCastShadows() ? scene.getShadowTextureCountPerLightType(light->getType()) : 0;
    const bool hasMap = count > 0 && light->getType() != Ogre::Light::LT_POINT; // of which OGRE has one view of six
    if (hasMap && next + count <= scene.getShadowTextureConfigList().size())
      addShadow(scene, next, count, frame.lights.back().shadow);
    next += count;
  }
  if (reuse) {
    const Places now = placesOf(scene);
    frame.objects = movedObjects(operation.places, now);
    operation.places = now;
    frame.reuse = {tyndall::Changes::Objects, operation.eye, ++operation.frame};
  }
  if (adjust) adjust(frame);
  const tyndall::Status status = effect_->render(frame);
  if (!status && status.message != message_) Ogre::LogManager::getSingleton().logError("Tyndall: " + status.message);
  message_ = status.message;
}

/// OGRE's cascades are textures of their own, Tyndall's layers of one: they are copied.
void TyndallPass::addShadow(Ogre::SceneManager& scene, std::size_t first, std::size_t count,
                            tyndall::ShadowMap& shadow) {
  Ogre::TexturePtr texture = scene.getShadowTexture(first);
  const Ogre::uint width = texture->getWidth(), height = texture->getHeight(), layers = static_cast<Ogre::uint>(count);
  if (layers > 1) {
    Ogre::TexturePtr& array = cascades_[first];
    Ogre::TextureManager& textures = Ogre::TextureManager::getSingleton();
    if (!array || array->getWidth() != width || array->getDepth() != layers) {
      if (array) textures.remove(array);
      array = textures.createManual("tyndall/cascades" + std::to_string(first), Ogre::RGN_INTERNAL,
                                    Ogre::TEX_TYPE_2D_ARRAY, width, height, layers, 0, texture->getFormat());
    }
    texture = array;
  }
  shadow.texture = nameOf(texture);
  shadow.array = count > 1;
  shadow.clipDepth = clipDepth();
  for (std::size_t i = 0; i < count; ++i) {
    const Ogre::TexturePtr& view = scene.getShadowTexture(first + i);
    const Ogre::Camera& camera = *view->getBuffer()->getRenderTarget()->getViewport(0)->getCamera();
    const int layer = static_cast<int>(i);
    shadow.views.push_back({mat4(clipFromView(camera) * camera.getViewMatrix(true)), layer});
    if (count > 1)
      copyImage_(nameOf(view), kTexture2D, 0, 0, 0, 0, shadow.texture, kTexture2DArray, 0, 0, 0, layer,
                 static_cast<int>(width), static_cast<int>(height), 1);
  }
}
