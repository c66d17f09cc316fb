#pragma once

#include <rviz/display_context.h>

#include <QString>

namespace navvi_rviz::plugin {

/// Makes the saved view of that name, in any case of letters, the current one, if there is one.
void choose_view(rviz::DisplayContext& context, const QString& name);

}  // namespace navvi_rviz::plugin
