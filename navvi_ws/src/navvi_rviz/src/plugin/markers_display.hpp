#pragma once

#include <rviz/default_plugin/marker_display.h>
#include <visualization_msgs/MarkerArray.h>

namespace navvi_rviz::plugin {

/// RViz's own markers, dressed for a vision (look::dress).
class MarkersDisplay : public rviz::MarkerDisplay {
 public:
  MarkersDisplay();
  void onInitialize() override;

 protected:
  void subscribe() override;
  void unsubscribe() override;

 private:
  void take(const visualization_msgs::MarkerArray::ConstPtr& markers);
};

}  // namespace navvi_rviz::plugin
