#include "plugin/markers_display.hpp"

#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>

#include <QPointer>
#include <algorithm>
#include <boost/make_shared.hpp>
#include <utility>

#include "look/dress.hpp"
#include "plugin/chosen.hpp"

namespace navvi_rviz::plugin {

using visualization_msgs::MarkerArray;

namespace {
constexpr char kMaterial[] = "navvi_rviz/standing";
}

MarkersDisplay::MarkersDisplay() {
  marker_topic_property_->setMessageType("visualization_msgs/MarkerArray");
  marker_topic_property_->setDescription("MarkerArray topic to subscribe to.");
}

MarkersDisplay::~MarkersDisplay() {
  if (standing_ != nullptr) clear();
}

void MarkersDisplay::onInitialize() {
  rviz::MarkerDisplay::onInitialize();
  standing_ = scene_node_->createChildSceneNode();
  auto& materials = Ogre::MaterialManager::getSingleton();
  const auto& group = Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;
  if (!materials.getByName(kMaterial, group))
    materials.create(kMaterial, group)->setLightingEnabled(false);
  // What is latched comes once more, and is dressed anew.
  Chosen::shared().on_change([display = QPointer<MarkersDisplay>(this), this] {
    if (!display) return;
    unsubscribe();
    reset();
    clear();
    last_ = {};
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
  MarkerArray now = *markers;
  for (auto& marker : now.markers) marker.header.stamp = ros::Time();
  if (now.markers == last_.markers) return;
  ++changes_;
  last_ = std::move(now);
  const auto others = boost::make_shared<MarkerArray>();
  const MarkerArray dressed = look::dress(last_, Chosen::shared().vision());
  const auto stands = [](const auto& marker) { return marker.ns == look::kStanding; };
  if (std::any_of(dressed.markers.begin(), dressed.markers.end(), stands)) clear();
  for (const auto& marker : dressed.markers)
    if (stands(marker))
      draw(marker);
    else
      others->markers.push_back(marker);
  incomingMarkerArray(others);
}

void MarkersDisplay::draw(const visualization_msgs::Marker& list) {
  Ogre::ManualObject* object = scene_manager_->createManualObject();
  object->estimateVertexCount(list.points.size() / 6 * 4);
  object->begin(kMaterial, Ogre::RenderOperation::OT_TRIANGLE_LIST);
  Ogre::uint32 count = 0;
  for (std::size_t first = 0; first + 6 <= list.points.size(); first += 6, count += 4) {
    const auto& color = list.colors[first / 3];
    for (const std::size_t corner : {0, 1, 2, 5}) {
      const auto& at = list.points[first + corner];
      object->position(static_cast<float>(at.x), static_cast<float>(at.y),
                       static_cast<float>(at.z));
      object->colour(color.r, color.g, color.b);
    }
    object->quad(count, count + 1, count + 2, count + 3);
  }
  object->end();
  standing_->attachObject(object);
}

void MarkersDisplay::clear() {
  while (standing_->numAttachedObjects() > 0)
    scene_manager_->destroyMovableObject(standing_->getAttachedObjects().front());
}

void MarkersDisplay::update(float wall_dt, float ros_dt) {
  rviz::MarkerDisplay::update(wall_dt, ros_dt);
  Ogre::Vector3 at;
  Ogre::Quaternion turn;
  if (!context_->getFrameManager()->getTransform("map", ros::Time(), at, turn)) return;
  standing_->setPosition(at);
  standing_->setOrientation(turn);
}

}  // namespace navvi_rviz::plugin
