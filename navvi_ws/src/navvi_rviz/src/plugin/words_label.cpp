#include "plugin/words_label.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <QStyle>
#include <QStyleOption>
#include <algorithm>

namespace navvi_rviz::plugin {
namespace {

constexpr int kPadding = 6;  // px, around words; the frame of the focus is in it
constexpr int kLeast = 8;    // px, of a font
constexpr int kFlags = Qt::TextWordWrap | Qt::AlignLeft | Qt::AlignVCenter;

}  // namespace

QSize WordsLabel::sizeHint() const {
  ensurePolished();
  const QFontMetrics metrics(font());
  return {metrics.horizontalAdvance(text()) + 2 * kPadding,
          lines_ * metrics.lineSpacing() + 2 * kPadding};
}

void WordsLabel::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  QStyleOption option;
  option.initFrom(this);
  style()->drawPrimitive(QStyle::PE_Widget, &option, &painter, this);
  const QRect room = rect().adjusted(kPadding, kPadding, -kPadding, -kPadding);
  QFont letters = font();
  const auto fits = [&] {
    const QRect needed = QFontMetrics(letters).boundingRect(room, kFlags, text());
    return needed.width() <= room.width() && needed.height() <= room.height();
  };
  while (letters.pixelSize() > kLeast && !fits()) letters.setPixelSize(letters.pixelSize() - 1);
  painter.setFont(letters);
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(room, kFlags, text());
}

}  // namespace navvi_rviz::plugin
