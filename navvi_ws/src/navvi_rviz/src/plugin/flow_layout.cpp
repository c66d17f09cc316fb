#include "plugin/flow_layout.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <QStyle>
#include <QStyleOption>
#include <algorithm>

namespace navvi_rviz::plugin {

constexpr int kPadding = 6;  // px, around words; the frame of the focus is in it
constexpr int kLeast = 8;    // px, of a font
constexpr int kFlags = Qt::TextWordWrap | Qt::AlignLeft | Qt::AlignVCenter;

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

FlowLayout::~FlowLayout() { qDeleteAll(items_); }

QLayoutItem* FlowLayout::takeAt(int index) {
  return index >= 0 && index < count() ? items_.takeAt(index) : nullptr;
}

QList<FlowLayout::Row> FlowLayout::rows(int width) const {
  QList<Row> rows;
  int left = 0;  // px
  for (QLayoutItem* item : items_) {
    if (item->isEmpty()) continue;
    const int wide = item->sizeHint().width();
    if (rows.isEmpty() || left < wide) {
      rows.append(Row());
      left = width;
    }
    rows.last().append(item);
    left -= wide + spacing();
  }
  return rows;
}

int FlowLayout::row_height(const Row& row) const {
  int height = 0;
  for (const QLayoutItem* item : row) height = std::max(height, item->sizeHint().height());
  return height;
}

int FlowLayout::heightForWidth(int width) const {
  int height = -spacing();
  for (const Row& row : rows(width)) height += row_height(row) + spacing();
  return std::max(0, height);
}

void FlowLayout::setGeometry(const QRect& rect) {
  QLayout::setGeometry(rect);
  int top = rect.top();
  for (const Row& row : rows(rect.width())) {
    int spare = rect.width() + spacing();
    for (const QLayoutItem* item : row) spare -= item->sizeHint().width() + spacing();
    const int height = row_height(row), more = std::max(0, spare) / static_cast<int>(row.size());
    int left = rect.left();
    for (QLayoutItem* item : row) {
      const int wide = std::min(rect.width(), item->sizeHint().width() + more);
      item->setGeometry({left, top, wide, height});
      left += wide + spacing();
    }
    top += height + spacing();
  }
}

QSize FlowLayout::minimumSize() const {
  QSize size;
  for (const QLayoutItem* item : items_) size = size.expandedTo(item->minimumSize());
  return size;
}

}  // namespace navvi_rviz::plugin
