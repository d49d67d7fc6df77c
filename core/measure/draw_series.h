// The series of one panel as lines and shapes. Data and fitted axes come in; drawn items go out, back to
// front.
#pragma once

#include "measure/drawing.h"
#include "measure/fit_axes.h"

namespace fb {

void drawSeries(const Figure& figure, const PlotPanel& panel, const PanelData& data, const PlotAxis& x,
                const PlotAxis& y, std::vector<DrawnItem>& items);

// The sample of a series in the legend, from `left`, around the height `middle`; and how wide it is.
void drawSwatch(const PlotSeries& series, double left, double middle, std::vector<DrawnItem>& items);
[[nodiscard]] double swatchWidth(const PlotSeries& series);

}  // namespace fb
