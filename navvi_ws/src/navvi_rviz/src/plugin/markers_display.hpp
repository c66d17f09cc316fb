#pragma once

#include <rviz/default_plugin/marker_display.h>
#include <visualization_msgs/MarkerArray.h>

namespace navvi_rviz::plugin {

/// RViz's own markers, dressed for a vision (look::dress). What stands is drawn without RViz's
/// objects: it is most of all triangles, and half of them look away.
class MarkersDisplay : public rviz::MarkerDisplay {
 public:
  MarkersDisplay();
  ~MarkersDisplay() override;
  void onInitialize() override;
  void update(float wall_dt, float ros_dt) override;
  /// How often what is drawn has changed, of all these displays.
  [[nodiscard]] static unsigned changes() { return changes_; }

 protected:
  void subscribe() override;
  void unsubscribe() override;

 private:
  void take(const visualization_msgs::MarkerArray::ConstPtr& markers);
  /// \param list  of the namespace look::kStanding
  void draw(const visualization_msgs::Marker& list);
  void clear();

  static inline unsigned changes_ = 0;
  visualization_msgs::MarkerArray last_;  ///< without times
  Ogre::SceneNode* standing_ = nullptr;  ///< map
};

}  // namespace navvi_rviz::plugin
