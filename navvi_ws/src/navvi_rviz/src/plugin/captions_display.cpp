#include "plugin/captions_display.hpp"

#include <OgreCamera.h>
#include <OgreViewport.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/ogre_helpers/render_system.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>

#include "look/solids.hpp"
#include "plugin/chosen.hpp"
#include "plugin/paint.hpp"
#include "plugin/views.hpp"

namespace navvi_rviz::plugin {
namespace {

constexpr double kAhead[] = {2.0, 4.0};  // m along the path, to where the edge arrow leads
constexpr double kLeastText = 26.0;      // px, of capital letters
constexpr double kMargin = 3.0;          // m, around what the view from above holds
constexpr double kRobot = 0.3;           // m, half of what plates leave free of the robot
constexpr double kPiece = 0.8;           // m, of the path, in which plates leave it free
constexpr double kLargest = 60.0;        // px/m, of that view
constexpr double kLowest = 0.75, kSteepest = 1.4;  // rad, down, of the view from behind
// Of its distance, by which RViz lifts its follower across its axis.
constexpr double kLift = 0.2;
constexpr double kUp = 1.0, kDown = 0.25;  // rad/s, of its turns

Eigen::Vector2d size_of(const Plate& plate) {
  return {plate.size().width(), plate.size().height()};
}

Eigen::Vector3d from(const geometry_msgs::Point& point, const geometry_msgs::Point& origin) {
  return {point.x + origin.x, point.y + origin.y, point.z + origin.z};
}

Eigen::AlignedBox3d whole(const visualization_msgs::Marker& marker) {
  Eigen::AlignedBox3d all;
  for (const Eigen::AlignedBox3d& solid : look::solids(marker)) all.extend(solid);
  return all;
}

}  // namespace

CaptionsDisplay::~CaptionsDisplay() = default;

void CaptionsDisplay::onInitialize() {
  rviz::RenderSystem::get()->prepareOverlays(context_->getSceneManager());
  reader_ = std::make_unique<Reader>();
  using visualization_msgs::MarkerArray;
  markers_ = update_nh_.subscribe<MarkerArray>(
      "navvi/markers", 1, [this](const MarkerArray::ConstPtr& msg) { take(*msg); });
  scene_ =
      update_nh_.subscribe<MarkerArray>("navvi/scene", 1, [this](const MarkerArray::ConstPtr& msg) {
        skyline_ = look::Skyline(*msg);
        pedestals_.clear();
        for (const auto& marker : msg->markers)
          if (marker.ns == "pedestal")
            for (const auto& solid : look::solids(marker)) pedestals_.push_back(solid);
      });
  moving_scene_ = update_nh_.subscribe<MarkerArray>("navvi/scene_moving", 1,
                                                    [this](const MarkerArray::ConstPtr& msg) {
                                                      movers_.clear();
                                                      for (const auto& marker : msg->markers)
                                                        movers_.push_back(whole(marker));
                                                    });
}

void CaptionsDisplay::onDisable() {
  for (auto& entry : plates_) entry.second.plate->hide();
}

void CaptionsDisplay::take(const visualization_msgs::MarkerArray& markers) {
  using visualization_msgs::Marker;
  labels_.clear();
  path_.clear();
  goal_parts_.clear();
  for (const Marker& marker : markers.markers) {
    if (marker.action != Marker::ADD) continue;
    if (marker.type == Marker::TEXT_VIEW_FACING)
      labels_[marker.id] = {marker.text, from(marker.pose.position, {})};
    if (marker.ns == "goal") goal_parts_.push_back(whole(marker));
    if (marker.ns == "path" && marker.id == 1)
      for (const auto& point : marker.points) path_.push_back(from(point, marker.pose.position));
  }
}

CaptionsDisplay::Seen CaptionsDisplay::see(const Eigen::Vector3d& place) const {
  const Ogre::Camera* camera = context_->getViewManager()->getCurrent()->getCamera();
  const Ogre::Vector3 at(static_cast<float>(place.x()), static_cast<float>(place.y()),
                         static_cast<float>(place.z()));
  const Ogre::Vector3 seen = camera->getViewMatrix() * at;
  Seen result{{seen.x, seen.y, seen.z}, std::nullopt};
  if (seen.z >= 0.0F) return result;
  const Ogre::Vector3 flat = camera->getProjectionMatrix() * seen;
  const Ogre::Viewport* port = camera->getViewport();
  result.pixel =
      Eigen::Vector2d(0.5 * (1.0 + static_cast<double>(flat.x)) * port->getActualWidth(),
                      0.5 * (1.0 - static_cast<double>(flat.y)) * port->getActualHeight());
  return result;
}

std::optional<navvi_types::Pose2> CaptionsDisplay::robot() const {
  Ogre::Vector3 at;
  Ogre::Quaternion turned;
  if (!context_->getFrameManager()->getTransform("base_link", ros::Time(), at, turned))
    return std::nullopt;
  return navvi_types::Pose2{{static_cast<double>(at.x), static_cast<double>(at.y)},
                            static_cast<double>(turned.getRoll().valueRadians())};
}

Plate& CaptionsDisplay::painted(const std::string& name, const std::string& key,
                                const std::function<QImage()>& paint) {
  Painted& entry = plates_[name];
  if (!entry.plate) entry.plate = std::make_unique<Plate>(name);
  const std::string full = Chosen::shared().name() + "/" + key;
  if (entry.key != full) entry.plate->set(paint());
  entry.key = full;
  return *entry.plate;
}

Plate& CaptionsDisplay::words(const std::string& name, const std::string& text, int height,
                              bool inverted) {
  const std::string key = text + "/" + std::to_string(height) + (inverted ? "!" : "");
  return painted(name, key, [&] {
    return paint_words(QString::fromStdString(text), height, Chosen::shared().vision(), inverted);
  });
}

void CaptionsDisplay::update(float wall_dt, float /*ros_dt*/) {
  const Ogre::Viewport* port = context_->getViewManager()->getCurrent()->getCamera()->getViewport();
  if (!port) return;
  const Eigen::Vector2d picture(port->getActualWidth(), port->getActualHeight());
  height_ = static_cast<int>(std::max(
      kLeastText, Chosen::shared().vision().text_height * std::max(1.0, picture.y() / 1080.0)));
  if (std::exchange(first_, false))
    choose_view(*context_,
                QString::fromStdString(ros::param::param<std::string>("~view", "chase")));
  onDisable();
  std::vector<screen::Rect> taken;
  show_banner(picture, taken);
  if (const auto pose = robot()) {
    show_from_above(*pose, picture, taken);
    show_from_behind(*pose, static_cast<double>(wall_dt));
    show_way(*pose, picture, taken);
    const Eigen::Vector3d at(pose->position.x(), pose->position.y(), kRobot);
    keep_free({at.array() - kRobot, at.array() + kRobot}, picture, taken);
  }
  for (const auto* things : {&goal_parts_, &pedestals_, &movers_})
    for (const Eigen::AlignedBox3d& thing : *things) keep_free(thing, picture, taken);
  for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
    const Eigen::Vector3d way = path_[i + 1] - path_[i];
    const Eigen::Vector3d half(0.5 * kPiece, 0.5 * kPiece, 0.0);
    for (double share = 0.0; share < 1.0; share += kPiece / std::max(kPiece, way.norm())) {
      const Eigen::Vector3d place = path_[i] + share * way;
      keep_free({place - half, place + half}, picture, taken);
    }
  }
  show_labels(picture, taken);
}

void CaptionsDisplay::show_banner(const Eigen::Vector2d& picture,
                                  std::vector<screen::Rect>& taken) {
  const status::Shown shown = reader_->shown();
  if (shown.banner.empty()) return;
  const bool inverted = shown.tone == status::Shown::Tone::alarm;
  int large = 2 * height_;
  Plate* plate = &words("banner", shown.banner, large, inverted);
  const double width = size_of(*plate).x();
  if (width > picture.x()) {
    large = static_cast<int>(0.95 * large * picture.x() / width);
    plate = &words("banner", shown.banner, large, inverted);
  }
  const Eigen::Vector2d corner(0.5 * (picture.x() - size_of(*plate).x()), 10.0);
  plate->show(corner.x(), corner.y());
  taken.emplace_back(corner, corner + size_of(*plate));
}

void CaptionsDisplay::show_way(const navvi_types::Pose2& robot, const Eigen::Vector2d& picture,
                               std::vector<screen::Rect>& taken) {
  const int size = 4 * height_;
  std::optional<screen::EdgeArrow> arrow;
  for (const double ahead : kAhead) {
    const auto way = screen::way_ahead(path_, robot.position, ahead);
    if (!way || arrow) break;
    Seen seen = see(*way);
    // What is ahead, but below the picture, is just before the robot.
    if (seen.pixel && robot.to_local(way->head<2>()).x() > 0.0)
      seen.pixel->y() = std::min(seen.pixel->y(), picture.y() - 1.0);
    arrow = screen::edge_arrow(seen.in_camera, seen.pixel, picture, 0.5 * size);
  }
  if (!arrow) return;
  Plate& plate = this->arrow("edge", arrow->angle, size);
  const Eigen::Vector2d corner = arrow->at - 0.5 * size_of(plate);
  plate.show(corner.x(), corner.y());
  taken.emplace_back(corner, corner + size_of(plate));
}

void CaptionsDisplay::show_labels(const Eigen::Vector2d& picture,
                                  const std::vector<screen::Rect>& taken) {
  std::vector<screen::Plate> wanted;
  std::vector<Painted*> plates;
  const auto add = [&](const std::string& name, const std::string& text,
                       const Eigen::Vector3d& at) {
    const Seen seen = see(at);
    if (!seen.pixel || (seen.pixel->array() < 0.0).any() ||
        (seen.pixel->array() > picture.array()).any())
      return;
    const Plate& plate = words(name, text, height_, false);
    plates.push_back(&plates_.at(name));
    wanted.push_back({*seen.pixel, size_of(plate), plates.back()->place});
  };
  for (const auto& [id, label] : labels_)
    add("label" + std::to_string(id), label.first, label.second);
  if (from_above() && start_ && !labels_.empty())
    add("start", reader_->words().of("picture/plate_start"), {start_->x(), start_->y(), 0.0});
  const std::vector<Eigen::Vector2d> corners = screen::place(wanted, picture, taken);
  for (std::size_t i = 0; i < plates.size(); ++i) {
    plates[i]->plate->show(corners[i].x(), corners[i].y());
    plates[i]->place = corners[i] - wanted[i].anchor;
  }
}

void CaptionsDisplay::keep_free(const Eigen::AlignedBox3d& thing, const Eigen::Vector2d& picture,
                                std::vector<screen::Rect>& taken) const {
  if (thing.isEmpty()) return;
  screen::Rect place;
  for (int corner = 0; corner < 8; ++corner) {
    const Seen seen = see(thing.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    if (!seen.pixel) return;
    place.extend(*seen.pixel);
  }
  if (place.intersects(screen::Rect(Eigen::Vector2d::Zero(), picture))) taken.push_back(place);
}

bool CaptionsDisplay::from_above() const {
  return context_->getViewManager()->getCurrent()->getClassId() == "rviz/TopDownOrtho";
}

void CaptionsDisplay::show_from_above(const navvi_types::Pose2& robot,
                                      const Eigen::Vector2d& picture,
                                      std::vector<screen::Rect>& taken) {
  const auto& guidance = reader_->guidance();
  if (guidance && guidance->leads() && goal_ != guidance->goal) {
    goal_ = guidance->goal;
    start_ = robot.position;
  }
  if (!from_above()) return;
  screen::Rect all(robot.position);
  if (goal_) all.extend(*goal_).extend(*start_);
  for (const Eigen::Vector3d& place : path_) all.extend(place.head<2>());
  const Eigen::Vector2d room = all.sizes() + Eigen::Vector2d::Constant(2.0 * kMargin);
  const double banner = std::min(5.0 * height_, 0.3 * picture.y());  // px, above all that
  const Eigen::Array2d free(picture.x(), picture.y() - banner);
  const double scale = std::min(kLargest, (free / room.array()).minCoeff());
  rviz::ViewController* view = context_->getViewManager()->getCurrent();
  view->subProp("X")->setValue(all.center().x());
  view->subProp("Y")->setValue(all.center().y() + 0.5 * banner / scale);
  view->subProp("Scale")->setValue(scale);
  const auto pixel = see({robot.position.x(), robot.position.y(), 0.0}).pixel;
  if (!pixel) return;
  Plate& plate = arrow("robot", robot.yaw, 3 * height_);
  const Eigen::Vector2d corner = *pixel - 0.5 * size_of(plate);
  plate.show(corner.x(), corner.y());
  taken.emplace_back(corner, corner + size_of(plate));
}

void CaptionsDisplay::show_from_behind(const navvi_types::Pose2& robot, double time) {
  rviz::ViewController* view = context_->getViewManager()->getCurrent();
  if (view->getName() != "Chase") return;
  const double distance = view->subProp("Distance")->getValue().toDouble();
  rviz::Property* focus = view->subProp("Focal Point");
  const double ahead = focus->subProp("X")->getValue().toDouble();
  const Eigen::Vector2d nose(std::cos(robot.yaw), std::sin(robot.yaw));
  const Eigen::Vector2d aside(-nose.y(), nose.x());
  double slope = 0.0;
  for (const double left : {-0.3, 0.0, 0.3}) {
    const Eigen::Vector2d place = robot.position + left * aside;
    slope = std::max(slope, skyline_.slope_over({place.x(), place.y(), 0.2}, -nose, distance));
  }
  const auto sees_over = [&](double angle) {
    const double up = distance * (std::sin(angle) + kLift * std::cos(angle));
    return up >= slope * (distance * (std::cos(angle) - kLift * std::sin(angle)) - ahead);
  };
  double wanted = kLowest;
  while (wanted < kSteepest && !sees_over(wanted)) wanted += 0.01;
  rviz::Property* pitch = view->subProp("Pitch");
  const double now = pitch->getValue().toDouble();
  pitch->setValue(now + std::clamp(wanted - now, -kDown * time, kUp * time));
}

Plate& CaptionsDisplay::arrow(const std::string& name, double angle, int size) {
  const int degrees = 10 * static_cast<int>(std::lround(angle * 18.0 / navvi_types::kPi));
  return painted(name, std::to_string(degrees) + "/" + std::to_string(size), [&] {
    return paint_arrow(degrees * navvi_types::kPi / 180.0, size, Chosen::shared().vision());
  });
}

}  // namespace navvi_rviz::plugin
