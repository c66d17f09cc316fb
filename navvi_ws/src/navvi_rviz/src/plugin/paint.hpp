#pragma once

#include <rviz/display_context.h>

#include <QImage>
#include <QString>

#include "look/vision.hpp"

namespace navvi_rviz::plugin {

/// Makes the saved view of that name, in any case of letters, the current one, if there is one.
void choose_view(rviz::DisplayContext& context, const QString& name);

[[nodiscard]] QColor color(const look::Color& color);

/// px, of a font whose capital letters are `height` px high
[[nodiscard]] int font_size(double height);

/// Words on a plate with an outline.
/// \param height    px, of capital letters
/// \param inverted  the colours of text and plate change places, for what must not be missed
[[nodiscard]] QImage paint_words(const QString& words, int height, const look::Vision& vision,
                                 bool inverted);

/// An arrow. \param angle  rad, where it points; 0 is right, counter-clockwise \param size  px
[[nodiscard]] QImage paint_arrow(double angle, int size, const look::Color& fill,
                                 const look::Vision& vision);

/// The robot as it is seen in the scene, a white disc with a black arrow. \param angle, size  as above
[[nodiscard]] QImage paint_robot(double angle, int size, const look::Vision& vision);

/// A ring, where it began. \param size  px
[[nodiscard]] QImage paint_start(int size, const look::Vision& vision);

}  // namespace navvi_rviz::plugin
