#include "plugin/markers_display.hpp"

#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>

#include <QPointer>
#include <boost/make_shared.hpp>

#include "look/dress.hpp"
#include "plugin/chosen.hpp"

namespace navvi_rviz::plugin {

using visualization_msgs::MarkerArray;

MarkersDisplay::MarkersDisplay() {
  marker_topic_property_->setMessageType("visualization_msgs/MarkerArray");
  marker_topic_property_->setDescription("MarkerArray topic to subscribe to.");
}

void MarkersDisplay::onInitialize() {
  rviz::MarkerDisplay::onInitialize();
  // What is latched comes once more, and is dressed anew.
  Chosen::shared().on_change([display = QPointer<MarkersDisplay>(this), this] {
    if (!display) return;
    unsubscribe();
    reset();
    subscribe();
  });
}

void MarkersDisplay::subscribe() {
  if (!isEnabled() || marker_topic_property_->getTopicStd().empty()) return;
  array_sub_ = update_nh_.subscribe(marker_topic_property_->getTopicStd(),
                                    static_cast<std::uint32_t>(queue_size_property_->getInt()),
                                    &MarkersDisplay::take, this);
}

void MarkersDisplay::unsubscribe() { array_sub_.shutdown(); }

void MarkersDisplay::take(const MarkerArray::ConstPtr& markers) {
  incomingMarkerArray(
      boost::make_shared<const MarkerArray>(look::dress(*markers, Chosen::shared().vision())));
}

}  // namespace navvi_rviz::plugin
