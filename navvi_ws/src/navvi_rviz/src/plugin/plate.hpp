#pragma once

#include <OgreTexture.h>

#include <QImage>
#include <string>

namespace Ogre {
class Overlay;
class PanelOverlayElement;
}  // namespace Ogre

namespace navvi_rviz::plugin {

/// A picture that lies on the screen, over everything in the scene.
class Plate {
 public:
  explicit Plate(const std::string& name);
  ~Plate();
  Plate(const Plate&) = delete;
  Plate& operator=(const Plate&) = delete;

  void set(const QImage& image);
  /// \param left, top  px, of the render window
  void show(double left, double top);
  void hide();
  [[nodiscard]] QSize size() const { return size_; }
  /// Where it is seen; empty: nowhere.
  [[nodiscard]] std::string shown() const;

 private:
  std::string name_;
  QSize size_;
  Ogre::Overlay* overlay_;
  Ogre::PanelOverlayElement* panel_;
  Ogre::TexturePtr texture_;
};

}  // namespace navvi_rviz::plugin
