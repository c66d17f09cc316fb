#include "plugin/paint.hpp"

#include <rviz/properties/property_tree_widget.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/window_manager_interface.h>

#include <QCoreApplication>
#include <QFontMetrics>
#include <QPainter>
#include <QPolygonF>
#include <QWidget>
#include <cmath>
#include <functional>
#include <navvi_types/angles.hpp>

namespace navvi_rviz::plugin {

void choose_view(rviz::DisplayContext& context, const QString& name) {
  rviz::ViewManager& views = *context.getViewManager();
  for (int i = 0; i < views.getNumViews(); ++i)
    if (views.getViewAt(i)->getName().compare(name, Qt::CaseInsensitive) == 0)
      views.setCurrentFrom(views.getViewAt(i));
  // A new view's hidden properties are still to be told to RViz's trees, which fall over them if
  // the next view has taken its place by then.
  if (auto* window = context.getWindowManager())
    for (auto* tree : window->getParentWindow()->findChildren<rviz::PropertyTreeWidget*>())
      QCoreApplication::sendPostedEvents(tree, QEvent::MetaCall);
}

namespace {

/// On a clear square with its origin in the middle, turned by an angle.
QImage drawn(double angle, int size, const std::function<void(QPainter&)>& draw) {
  QImage image(size, size, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(0.5 * size, 0.5 * size);
  painter.rotate(-angle * 180.0 / navvi_types::kPi);
  draw(painter);
  return image;
}

QPen outline(const look::Color& shade, double width) {
  return {color(shade), width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin};
}

}  // namespace

QColor color(const look::Color& color) {
  return QColor::fromRgbF(static_cast<double>(color.r), static_cast<double>(color.g),
                          static_cast<double>(color.b));
}

int font_size(double height) { return static_cast<int>(std::ceil(1.4 * height)); }

QImage paint_words(const QString& words, int height, const look::Vision& vision, bool inverted) {
  QFont font("DejaVu Sans");
  font.setPixelSize(font_size(height));
  font.setBold(true);
  const int pad = height / 2, line = std::max(2, height / 10);
  const QFontMetrics metrics(font);
  QImage image(metrics.horizontalAdvance(words) + 2 * pad + 4 * line,
               metrics.height() + pad + 2 * line, QImage::Format_ARGB32);
  const QColor plate = color(inverted ? vision.text : vision.plate);
  const QColor text = color(inverted ? vision.plate : vision.text);
  image.fill(plate);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::TextAntialiasing);
  painter.setFont(font);
  // The outline in the text's colour, in one of the plate's: one of the two is always seen.
  painter.setPen(QPen(text, line));
  painter.drawRect(image.rect().adjusted(line + line / 2, line + line / 2, -line - line / 2 - 1,
                                         -line - line / 2 - 1));
  painter.drawText(image.rect(), Qt::AlignCenter, words);
  return image;
}

QImage paint_arrow(double angle, int size, const look::Color& fill, const look::Vision& vision) {
  const double s = 0.4 * size;
  const QPolygonF arrow({{-s, -0.35 * s},
                         {0.1 * s, -0.35 * s},
                         {0.1 * s, -0.9 * s},
                         {s, 0.0},
                         {0.1 * s, 0.9 * s},
                         {0.1 * s, 0.35 * s},
                         {-s, 0.35 * s}});
  return drawn(angle, size, [&](QPainter& painter) {
    painter.setPen(outline(vision.dark, 0.14 * size));
    painter.setBrush(color(vision.dark));
    painter.drawPolygon(arrow);
    painter.setPen(outline(vision.bright, 0.06 * size));
    painter.setBrush(color(fill));
    painter.drawPolygon(arrow);
  });
}

QImage paint_robot(double angle, int size, const look::Vision& vision) {
  const double s = 0.44 * size;
  return drawn(angle, size, [&](QPainter& painter) {
    painter.setPen(outline(vision.dark, 0.08 * size));
    painter.setBrush(color(vision.fill.at("robot")));
    painter.drawEllipse(QPointF(), s, s);
    painter.setPen(Qt::NoPen);
    painter.setBrush(color(vision.dark));
    painter.drawPolygon(
        QPolygonF({{0.9 * s, 0.0}, {-0.6 * s, 0.55 * s}, {-0.3 * s, 0.0}, {-0.6 * s, -0.55 * s}}));
  });
}

QImage paint_start(int size, const look::Vision& vision) {
  return drawn(0.0, size, [&](QPainter& painter) {
    painter.setPen(outline(vision.dark, 0.32 * size));
    painter.drawEllipse(QPointF(), 0.33 * size, 0.33 * size);
    painter.setPen(outline(vision.bright, 0.16 * size));
    painter.drawEllipse(QPointF(), 0.33 * size, 0.33 * size);
  });
}

}  // namespace navvi_rviz::plugin
