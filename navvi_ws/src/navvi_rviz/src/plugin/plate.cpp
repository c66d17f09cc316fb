#include "plugin/plate.hpp"

#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>
#include <Overlay/OgreOverlay.h>
#include <Overlay/OgreOverlayManager.h>
#include <Overlay/OgrePanelOverlayElement.h>

namespace navvi_rviz::plugin {

Plate::Plate(const std::string& name) : name_("navvi_rviz/" + name) {
  auto& manager = Ogre::OverlayManager::getSingleton();
  overlay_ = manager.create(name_);
  panel_ = dynamic_cast<Ogre::PanelOverlayElement*>(
      manager.createOverlayElement("Panel", name_ + "/panel"));
  panel_->setMetricsMode(Ogre::GMM_PIXELS);
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      name_, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
  pass->createTextureUnitState()->setTextureFiltering(Ogre::TFO_NONE);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass->setLightingEnabled(false);
  pass->setDepthCheckEnabled(false);
  panel_->setMaterialName(name_);
  overlay_->add2D(panel_);
}

Plate::~Plate() {
  auto& manager = Ogre::OverlayManager::getSingleton();
  manager.destroy(overlay_);
  manager.destroyOverlayElement(panel_);
  Ogre::MaterialManager::getSingleton().remove(
      name_, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  if (texture_) Ogre::TextureManager::getSingleton().remove(texture_);
}

void Plate::set(const QImage& image) {
  if (image.isNull()) return;
  const auto width = static_cast<Ogre::uint32>(image.width());
  const auto height = static_cast<Ogre::uint32>(image.height());
  if (size_ != image.size()) {
    if (texture_) Ogre::TextureManager::getSingleton().remove(texture_);
    texture_ = Ogre::TextureManager::getSingleton().createManual(
        name_, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, Ogre::TEX_TYPE_2D, width,
        height, 0, Ogre::PF_A8R8G8B8, Ogre::TU_DEFAULT);
    panel_->getMaterial()->getTechnique(0)->getPass(0)->getTextureUnitState(0)->setTexture(
        texture_);
    size_ = image.size();
    panel_->setDimensions(static_cast<float>(width), static_cast<float>(height));
  }
  QImage pixels = image.convertToFormat(QImage::Format_ARGB32);
  texture_->getBuffer()->blitFromMemory(
      Ogre::PixelBox(width, height, 1, Ogre::PF_A8R8G8B8, pixels.bits()));
}

void Plate::show(double left, double top) {
  panel_->setPosition(static_cast<float>(static_cast<int>(left)),
                      static_cast<float>(static_cast<int>(top)));
  overlay_->show();
}

std::string Plate::shown() const {
  if (!overlay_->isVisible()) return "";
  return std::to_string(panel_->getLeft()) + "/" + std::to_string(panel_->getTop());
}

void Plate::hide() { overlay_->hide(); }

}  // namespace navvi_rviz::plugin
