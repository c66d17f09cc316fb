#include "plugin/captions_display.hpp"

#include <OgreCamera.h>
#include <OgreRenderTarget.h>
#include <OgreRoot.h>
#include <OgreViewport.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/ogre_helpers/render_system.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>
#include <rviz/window_manager_interface.h>

#include <QEvent>
#include <QWidget>
#include <algorithm>
#include <cmath>
#include <limits>
#include <navvi_types/angles.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>
#include <navvi_types/transform_listener.hpp>

#include "plugin/chosen.hpp"
#include "plugin/markers_display.hpp"
#include "plugin/paint.hpp"

namespace navvi_rviz::plugin {
namespace {

constexpr int kGoal = 0;                 // of the label of the goal among feedback_node's markers
constexpr double kAhead[] = {2.0, 4.0};  // m along the path, to where the edge arrow leads
constexpr double kLeastText = 26.0;      // px, of capital letters
constexpr double kMargin = 3.0;          // m, around what the view from above holds
constexpr double kRobot = 0.3;           // m, half of what plates leave free of the robot
constexpr double kPiece = 0.8;           // m, of the path, in which plates leave it free
constexpr double kNextWay = 3.5;   // m, around the robot, in which plates never cover the path
constexpr double kSeldom = 0.2;    // s, between two pictures where nothing is known to change
constexpr double kTell = 1.0;      // s, between two words on its rate
constexpr double kHurry = 8.0;     // m, around it, in which what moves moves the banner
constexpr double kNear = 0.3;      // m, before the camera
constexpr double kBanner = 0.115;  // of the picture's height: the banner's letters at most
constexpr double kLeastShare = 0.6;  // of that, where it has no room
constexpr double kFar = 0.3;       // of the picture's height, from a place to its plate at most
constexpr double kArrow = 0.2;     // of the picture's height: the arrow at its edge at most
constexpr double kLargest = 60.0;  // px/m, of that view
constexpr double kLowest = 0.75, kSteepest = 1.4;  // rad, down, of the view from behind
// Of its distance, by which RViz lifts its follower across its axis.
constexpr double kLift = 0.2;
constexpr double kUp = 1.0, kDown = 0.25;  // rad/s, of its turns
constexpr double kUsual = 9.0, kFarthest = 16.0;  // m, of its distance
constexpr double kOut = 8.0, kIn = 2.0;           // m/s, by which that grows and shrinks

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

Eigen::AlignedBox3d box_of(const navvi_types::MovingThing& thing) {
  Eigen::Vector2d half = Eigen::Vector2d::Constant(thing.radius);
  if (thing.length > 0.0) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(thing.pose.yaw).matrix().cwiseAbs();
    half = 0.5 * turn * Eigen::Vector2d(thing.length, thing.width);
  }
  const Eigen::Vector2d low = thing.pose.position - half, high = thing.pose.position + half;
  return {Eigen::Vector3d(low.x(), low.y(), thing.floor),
          Eigen::Vector3d(high.x(), high.y(), thing.floor + thing.height)};
}

}  // namespace

CaptionsDisplay::~CaptionsDisplay() { Ogre::Root::getSingleton().removeFrameListener(this); }

void CaptionsDisplay::onInitialize() {
  rviz::RenderSystem::get()->prepareOverlays(context_->getSceneManager());
  if (auto* window = context_->getWindowManager())
    window->getParentWindow()->installEventFilter(this);
  reader_ = std::make_unique<Reader>();
  cost_.since = ros::SteadyTime::now();
  Ogre::Root::getSingleton().addFrameListener(this);
  diagnostics_ = update_nh_.advertise<diagnostic_msgs::DiagnosticArray>("diagnostics", 1);
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
  obstacles_ = navvi_types::subscribe<navvi_msgs::Obstacles>(
      update_nh_, "navvi/obstacles", 1, navvi_types::from_msg,
      [this](const navvi_types::Obstacles& obstacles) {
        movers_.clear();
        for (const auto& thing : obstacles.things)
          movers_.push_back({thing.thing_class, box_of(thing)});
      });
}

bool CaptionsDisplay::eventFilter(QObject* window, QEvent* event) {
  auto* manager = dynamic_cast<rviz::VisualizationManager*>(context_);
  if (manager != nullptr && event->type() == QEvent::Hide && !event->spontaneous())
    manager->stopUpdate();
  return Display::eventFilter(window, event);
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
  if (seen.z < 0.0F) result.pixel = pixel(result.in_camera);
  return result;
}

Eigen::Vector2d CaptionsDisplay::pixel(const Eigen::Vector3d& in_camera) const {
  const Ogre::Camera* camera = context_->getViewManager()->getCurrent()->getCamera();
  const Ogre::Vector3 flat =
      camera->getProjectionMatrix() * Ogre::Vector3(static_cast<float>(in_camera.x()),
                                                    static_cast<float>(in_camera.y()),
                                                    static_cast<float>(in_camera.z()));
  const Ogre::Viewport* port = camera->getViewport();
  return {0.5 * (1.0 + static_cast<double>(flat.x)) * port->getActualWidth(),
          0.5 * (1.0 - static_cast<double>(flat.y)) * port->getActualHeight()};
}

std::optional<navvi_types::Pose2> CaptionsDisplay::robot() const {
  (void)navvi_types::newest(*context_->getTF2BufferPtr(), fixed_frame_.toStdString(), "base_link",
                            ros::Time::now());
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
  picture_ = Eigen::Vector2d(port->getActualWidth(), port->getActualHeight());
  height_ = static_cast<int>(std::max(
      kLeastText, Chosen::shared().vision().text_height * std::max(1.0, picture_.y() / 1080.0)));
  if (std::exchange(first_, false))
    choose_view(*context_,
                QString::fromStdString(ros::param::param<std::string>("~view", "chase")));
  onDisable();
  const auto pose = robot();
  const status::Shown shown = reader_->shown();
  const Mover* const threat = pose ? this->threat(shown, *pose) : nullptr;
  if (pose) show_from_behind(*pose, threat, static_cast<double>(wall_dt));
  taken_ = things(pose, kHurry);
  if (pose) show_from_above(*pose);
  show_banner(shown);
  if (threat != nullptr) show_threat(*threat);
  const screen::Taken others = things(pose, std::numeric_limits<double>::infinity());
  taken_.always.insert(taken_.always.end(), others.always.begin(), others.always.end());
  if (pose) show_way(*pose);
  show_labels();
  draw_if_changed(*context_->getViewManager()->getCurrent()->getCamera());
  tell_rate();
}

void CaptionsDisplay::draw_if_changed(const Ogre::Camera& camera) {
  Drawn now{camera.getViewMatrix(), camera.getProjectionMatrix(), MarkersDisplay::changes(), {}};
  for (const auto& [name, entry] : plates_) now.plates += name + entry.key + entry.plate->shown();
  const ros::SteadyTime time = ros::SteadyTime::now();
  const bool due = !(now == drawn_) || (time - drawn_at_).toSec() >= kSeldom;
  camera.getViewport()->getTarget()->setAutoUpdated(due);
  if (!due) return;
  drawn_ = std::move(now);
  drawn_at_ = time;
  ++cost_.drawn;
}

bool CaptionsDisplay::frameStarted(const Ogre::FrameEvent& /*event*/) {
  begun_ = std::clock();
  return true;
}

bool CaptionsDisplay::frameEnded(const Ogre::FrameEvent& /*event*/) {
  cost_.used += std::clock() - begun_;
  return true;
}

void CaptionsDisplay::tell_rate() {
  const ros::SteadyTime time = ros::SteadyTime::now();
  const double past = (time - cost_.since).toSec();
  if (past < kTell || cost_.drawn == 0) return;
  diagnostic_msgs::DiagnosticArray msg;
  msg.header.stamp = ros::Time::now();
  msg.status.emplace_back();
  msg.status[0].name = "navvi/picture";
  const auto add = [&](const char* key, double value) {
    diagnostic_msgs::KeyValue pair;
    pair.key = key;
    pair.value = QString::number(value, 'f', 1).toStdString();
    msg.status[0].values.push_back(pair);
  };
  add("frames_per_second", cost_.drawn / past);
  add("processor_ms_per_frame", 1e3 * static_cast<double>(cost_.used) / CLOCKS_PER_SEC / cost_.drawn);
  diagnostics_.publish(msg);
  cost_ = {0, 0, time};
}

const CaptionsDisplay::Mover* CaptionsDisplay::threat(const status::Shown& shown,
                                                      const navvi_types::Pose2& robot) const {
  const auto& guidance = reader_->status().guidance();
  Eigen::Vector2d place = robot.position;
  if (guidance && guidance->state == navvi_types::Guidance::State::blocked)
    if (const auto way = screen::way_ahead(path_, place, guidance->blocked_distance))
      place = way->head<2>();
  const Mover* nearest = nullptr;
  const auto away = [&](const Mover& mover) {
    return (mover.place.center().head<2>() - place).norm();
  };
  for (const Mover& mover : movers_) {
    // Who guides may not know the class of what the picture knows.
    const bool meant =
        mover.thing_class == shown.mover || shown.mover == navvi_types::ThingClass::other;
    if (meant && (nearest == nullptr || away(mover) < away(*nearest))) nearest = &mover;
  }
  return nearest;
}

void CaptionsDisplay::show_threat(const Mover& threat) {
  const Seen middle = see(threat.place.center());
  const auto edge = screen::edge_arrow(middle.in_camera, middle.pixel, picture_, 2.0 * height_);
  if (edge) show_edge_arrow("threat", *edge, Chosen::shared().vision().text);
  const std::string name =
      reader_->status().words().of(std::string("words/") + to_string(threat.thing_class));
  words("who", name, height_, true);
  const screen::Rect place = seen(threat.place);
  show_beside("who", edge ? edge->at
                          : Eigen::Vector2d(place.center().x(), std::max(0.0, place.min().y())));
}

void CaptionsDisplay::show_beside(const std::string& name, const Eigen::Vector2d& place) {
  Painted& entry = plates_.at(name);
  const Eigen::Vector2d size = size_of(*entry.plate);
  const auto corner = screen::place({place, size, entry.place}, picture_, taken_);
  if (!corner) return;
  const screen::Rect mine(*corner, *corner + size);
  // Far from its place, it would seem to name another.
  if (mine.exteriorDistance(place) > kFar * picture_.y()) return;
  entry.place = *corner - place;
  entry.plate->show(corner->x(), corner->y());
  taken_.always.push_back(mine);
}

void CaptionsDisplay::show_banner(const status::Shown& shown) {
  if (shown.banner.empty()) return;
  const bool inverted = shown.tone == status::Shown::Tone::alarm;
  if (banner_.text != shown.banner) banner_ = {shown.banner, 1.0};
  int large = static_cast<int>(
      banner_.share *
      std::min(2.0 * height_, std::max(kBanner * picture_.y(), static_cast<double>(kLeastText))));
  Plate* plate = &words("banner", shown.banner, large, inverted);
  const double width = size_of(*plate).x();
  if (width > picture_.x()) {
    large = static_cast<int>(0.95 * large * picture_.x() / width);
    plate = &words("banner", shown.banner, large, inverted);
  }
  const Eigen::Vector2d size = size_of(*plate);
  const Eigen::Vector2d usual(0.5 * picture_.x(), size.y() + 20.0);
  std::optional<Eigen::Vector2d>& before = plates_.at("banner").place;
  const auto room = screen::place({usual, size, before}, picture_, {taken_.always, {}});
  // For whom letters cannot be too large they stay.
  if (!room && Chosen::shared().vision().text_height <= kLeastText)
    banner_.share = std::max(kLeastShare, 0.85 * banner_.share);
  // What must not be missed is shown, whatever it covers.
  const Eigen::Vector2d corner =
      room.value_or(Eigen::Vector2d(0.5 * (picture_.x() - size.x()), 10.0));
  before = corner - usual;
  plate->show(corner.x(), corner.y());
  taken_.always.emplace_back(corner, corner + size);
}

void CaptionsDisplay::show_way(const navvi_types::Pose2& robot) {
  std::optional<screen::EdgeArrow> arrow;
  for (const double ahead : kAhead) {
    const auto way = screen::way_ahead(path_, robot.position, ahead);
    if (!way || arrow) break;
    Seen seen = see(*way);
    // What is ahead, but below the picture, is just before the robot.
    if (seen.pixel && robot.to_local(way->head<2>()).x() > 0.0)
      seen.pixel->y() = std::min(seen.pixel->y(), picture_.y() - 1.0);
    arrow = screen::edge_arrow(seen.in_camera, seen.pixel, picture_, 0.5 * edge_size());
  }
  if (arrow) show_edge_arrow("edge", *arrow, Chosen::shared().vision().fill.at("path"));
}

void CaptionsDisplay::show_edge_arrow(const std::string& name, const screen::EdgeArrow& arrow,
                                      const look::Color& fill) {
  const Plate& plate = pointer(name, arrow.angle, edge_size(), [&](double angle, int size) {
    return paint_arrow(angle, size, fill, Chosen::shared().vision());
  });
  show_beside(name, arrow.at + Eigen::Vector2d(0.0, 0.5 * size_of(plate).y()));
}

void CaptionsDisplay::show_labels() {
  const screen::Rect all(Eigen::Vector2d::Zero(), picture_);
  for (const auto& [id, label] : labels_) {
    Seen seen = see(label.second);
    if (!seen.pixel) continue;
    // The goal's stands at the edge where the goal is beyond it.
    if (id == kGoal) seen.pixel = seen.pixel->cwiseMax(all.min()).cwiseMin(all.max());
    if (!all.contains(*seen.pixel)) continue;
    const std::string name = "label" + std::to_string(id);
    words(name, label.first, height_, false);
    show_beside(name, *seen.pixel);
  }
}

screen::Rect CaptionsDisplay::seen(const Eigen::AlignedBox3d& thing) const {
  screen::Rect place;
  if (thing.isEmpty()) return place;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d at =
        see(thing.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))).in_camera;
    if (!from_above() && at.z() > -kNear) {
      if (at.z() > kNear) continue;
      at.z() = -kNear;
    }
    place.extend(pixel(at));
  }
  return place;
}

screen::Taken CaptionsDisplay::things(const std::optional<navvi_types::Pose2>& robot,
                                      double reach) const {
  screen::Taken taken;
  const auto add = [&](const Eigen::AlignedBox3d& thing, std::vector<screen::Rect>& to) {
    const screen::Rect place = seen(thing);
    if (!place.isEmpty() && place.intersects(screen::Rect(Eigen::Vector2d::Zero(), picture_)))
      to.push_back(place);
  };
  const auto away = [&](const Eigen::Vector3d& place) {
    return robot ? (place.head<2>() - robot->position).norm() : 0.0;
  };
  if (robot) {
    const Eigen::Vector3d at(robot->position.x(), robot->position.y(), kRobot);
    add({at.array() - kRobot, at.array() + kRobot}, taken.always);
  }
  for (const Mover& mover : movers_)
    if (away(mover.place.center()) <= reach) add(mover.place, taken.always);
  for (const Eigen::AlignedBox3d& part : goal_parts_) add(part, taken.always);
  for (const Eigen::AlignedBox3d& pedestal : pedestals_) add(pedestal, taken.rather);
  for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
    const Eigen::Vector3d way = path_[i + 1] - path_[i];
    const Eigen::Vector3d half(0.5 * kPiece, 0.5 * kPiece, 0.0);
    for (double share = 0.0; share < 1.0; share += kPiece / std::max(kPiece, way.norm())) {
      const Eigen::Vector3d place = path_[i] + share * way;
      add({place - half, place + half}, away(place) <= kNextWay ? taken.always : taken.rather);
    }
  }
  return taken;
}

bool CaptionsDisplay::from_above() const {
  return context_->getViewManager()->getCurrent()->getClassId() == "rviz/TopDownOrtho";
}

void CaptionsDisplay::show_from_above(const navvi_types::Pose2& robot) {
  const auto& guidance = reader_->status().guidance();
  if (guidance && guidance->leads() && goal_ != guidance->goal) {
    goal_ = guidance->goal;
    start_ = robot.position;
  }
  if (!from_above()) return;
  screen::Rect all(robot.position);
  if (goal_) all.extend(*goal_).extend(*start_);
  for (const Eigen::Vector3d& place : path_) all.extend(place.head<2>());
  const Eigen::Vector2d room = all.sizes() + Eigen::Vector2d::Constant(2.0 * kMargin);
  const double banner = std::min(5.0 * height_, 0.3 * picture_.y());  // px, above all that
  const double symbol = 3.0 * height_;  // px, of the robot's
  const Eigen::Array2d free(picture_.x() - symbol, picture_.y() - banner - symbol);
  const double scale = std::min(kLargest, (free / room.array()).minCoeff());
  rviz::ViewController* view = context_->getViewManager()->getCurrent();
  view->subProp("X")->setValue(all.center().x());
  view->subProp("Y")->setValue(all.center().y() + 0.5 * banner / scale);
  view->subProp("Scale")->setValue(scale);
  const auto show = [&](const std::string& name, const Eigen::Vector2d& at, double angle, int size,
                        const Paint& paint) {
    const auto pixel = see({at.x(), at.y(), 0.0}).pixel;
    if (!pixel) return;
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * size), corner = *pixel - half;
    const screen::Rect place(corner, corner + 2.0 * half);
    pointer(name, angle, size, paint).show(corner.x(), corner.y());
    taken_.always.push_back(place);
  };
  const look::Vision& vision = Chosen::shared().vision();
  show("robot", robot.position, robot.yaw, 3 * height_,
       [&](double angle, int size) { return paint_robot(angle, size, vision); });
  if (start_ && !path_.empty() && scale * (*start_ - robot.position).norm() > 2.0 * height_)
    show("start", *start_, 0.0, height_,
         [&](double, int size) { return paint_start(size, vision); });
}

void CaptionsDisplay::show_from_behind(const navvi_types::Pose2& robot, const Mover* threat,
                                       double time) {
  rviz::ViewController* view = context_->getViewManager()->getCurrent();
  if (view->getName() != "Chase") return;
  rviz::Property* away = view->subProp("Distance");
  double distance = away->getValue().toDouble();
  const bool sought =
      threat != nullptr &&
      !screen::Rect(Eigen::Vector2d::Zero(), picture_).contains(seen(threat->place));
  if (sought || threat == nullptr) {
    distance += std::clamp((sought ? kFarthest : kUsual) - distance, -kIn * time, kOut * time);
    away->setValue(distance);
  }
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

int CaptionsDisplay::edge_size() const {
  return std::min(4 * height_, static_cast<int>(kArrow * picture_.y()));
}

Plate& CaptionsDisplay::pointer(const std::string& name, double angle, int size,
                                const Paint& paint) {
  const int degrees = 10 * static_cast<int>(std::lround(angle * 18.0 / navvi_types::kPi));
  return painted(name, std::to_string(degrees) + "/" + std::to_string(size),
                 [&] { return paint(degrees * navvi_types::kPi / 180.0, size); });
}

}  // namespace navvi_rviz::plugin
