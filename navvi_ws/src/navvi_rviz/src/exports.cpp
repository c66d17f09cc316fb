// What RViz finds in this library by plugins.xml.

#include <pluginlib/class_list_macros.hpp>

#include "plugin/captions_display.hpp"
#include "plugin/markers_display.hpp"
#include "plugin/panel.hpp"

PLUGINLIB_EXPORT_CLASS(navvi_rviz::plugin::CaptionsDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(navvi_rviz::plugin::MarkersDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(navvi_rviz::plugin::Panel, rviz::Panel)
