// Curves, dots and areas of a chart, by VTK's chart without its axes.
//
// VTK is given places between 0 and 1 instead of values: it holds them as float, and its own
// logarithmic axes put the first picture's curves in the wrong place.
#include "chart.hh"

#include <vtkAutoInit.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotArea.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkTable.h>

#include <cmath>

VTK_MODULE_INIT(vtkRenderingContextOpenGL2)

namespace {

// Pixels of a figure 900 high.
const double line_width = 2.5;
const double cap_width = 9.0; // of error bars

// ---------------------------------------------------------------------------------

/// A table of places for VTK: a column for each array.
vtkSmartPointer<vtkTable> table_of(const std::vector<std::vector<double>> &columns)
{
    const char *const names[] = {"x", "y", "z"};
    auto table = vtkSmartPointer<vtkTable>::New();
    for (size_t c = 0; c < columns.size(); c++) {
        vtkNew<vtkDoubleArray> column;
        column->SetName(names[c]);
        for (double value : columns[c]) {
            column->InsertNextValue(value);
        }
        table->AddColumn(column);
    }
    return table;
}

std::vector<double> places_of(const pm_chart_axis &axis, const std::vector<double> &values)
{
    std::vector<double> places;
    for (double value : values) {
        places.push_back(axis.at(value));
    }
    return places;
}

void add_line(vtkChartXY *xy, const std::vector<double> &x, const std::vector<double> &y,
              pm_colour colour, double width, bool dashes)
{
    vtkNew<vtkPlotLine> line;
    line->SetInputData(table_of({x, y}), 0, 1);
    line->SetColor(colour.r, colour.g, colour.b, 255);
    line->SetWidth(static_cast<float>(width));
    line->GetPen()->SetLineType(dashes ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
    xy->AddPlot(line);
}

void add_markers(vtkChartXY *xy, const pm_chart_sheet &s, const pm_chart_series &series)
{
    vtkNew<vtkPlotPoints> points;
    points->SetInputData(
        table_of({places_of(s.chart->x, series.x), places_of(s.chart->y, series.high)}), 0, 1);
    points->SetColor(series.colour.r, series.colour.g, series.colour.b, 255);
    points->SetMarkerStyle(series.look == PM_CHART_DOTS ? vtkPlotPoints::CIRCLE
                                                        : vtkPlotPoints::DIAMOND);
    points->SetMarkerSize(static_cast<float>(s.pixels(pm_chart_marker_size)));
    xy->AddPlot(points);
}

void add_curve(vtkChartXY *xy, const pm_chart_sheet &s, const pm_chart_series &series)
{
    if (series.look == PM_CHART_DOTS || series.look == PM_CHART_DIAMONDS) {
        add_markers(xy, s, series);
        return;
    }
    std::vector<double> x = places_of(s.chart->x, series.x);
    std::vector<double> y = places_of(s.chart->y, series.high);
    if (series.look == PM_CHART_STEPS) {
        for (size_t i = x.size(); i-- > 1;) {
            x.insert(x.begin() + static_cast<std::ptrdiff_t>(i), x[i]);
            y.insert(y.begin() + static_cast<std::ptrdiff_t>(i), y[i - 1]);
        }
    }
    add_line(xy, x, y, series.colour, s.pixels(line_width), series.look == PM_CHART_DASHES);
}

void add_area(vtkChartXY *xy, const std::vector<double> &x, const std::vector<double> &low,
              const std::vector<double> &high, pm_colour colour, double opacity)
{
    vtkNew<vtkPlotArea> area;
    area->SetInputData(table_of({x, low, high}));
    area->SetInputArray(0, "x");
    area->SetInputArray(1, "y");
    area->SetInputArray(2, "z");
    area->GetBrush()->SetColor(colour.r, colour.g, colour.b,
                               static_cast<unsigned char>(std::lround(255.0 * opacity)));
    area->GetPen()->SetLineType(vtkPen::NO_PEN);
    xy->AddPlot(area);
}

/// All bars as one area, which has no height between them.
void add_bars(vtkChartXY *xy, const pm_chart_sheet &s, const pm_chart_series &series)
{
    double ground = s.chart->y.log ? 0.0 : s.chart->y.at(0.0);
    std::vector<double> x;
    std::vector<double> high;
    for (size_t i = 0; i < series.x.size(); i++) {
        double left = s.chart->x.at(series.x[i] - 0.5 * series.width);
        double right = s.chart->x.at(series.x[i] + 0.5 * series.width);
        double top = s.chart->y.at(series.high[i]);
        x.insert(x.end(), {left, left, right, right});
        high.insert(high.end(), {ground, top, top, ground});
    }
    add_area(xy, x, std::vector<double>(x.size(), ground), high, series.colour, 1.0);
}

/// A stroke and its two caps, each a line of two points.
void add_error(vtkChartXY *xy, const pm_chart_sheet &s, const pm_chart_series &series, size_t i)
{
    bool turned = series.kind == PM_CHART_IS_ERRORS_X;
    const pm_chart_axis &along = turned ? s.chart->x : s.chart->y;
    double middle = (turned ? s.chart->y : s.chart->x).at(series.x[i]);
    double cap = 0.5 * s.pixels(cap_width) / (turned ? s.height : s.width);
    double low = along.at(series.low[i]);
    double high = along.at(series.high[i]);
    const std::vector<double> across[3] = {
        {middle, middle}, {middle - cap, middle + cap}, {middle - cap, middle + cap}};
    const std::vector<double> length[3] = {{low, high}, {low, low}, {high, high}};
    for (int k = 0; k < 3; k++) {
        add_line(xy, turned ? length[k] : across[k], turned ? across[k] : length[k],
                 series.colour, s.pixels(1.5), false);
    }
}

void add_series(vtkChartXY *xy, const pm_chart_sheet &s, const pm_chart_series &series)
{
    switch (series.kind) {
    case PM_CHART_IS_CURVE:
        add_curve(xy, s, series);
        break;
    case PM_CHART_IS_BARS:
        add_bars(xy, s, series);
        break;
    case PM_CHART_IS_BAND:
        add_area(xy, places_of(s.chart->x, series.x), places_of(s.chart->y, series.low),
                 places_of(s.chart->y, series.high), series.colour, 0.3);
        break;
    case PM_CHART_IS_ERRORS_X:
    case PM_CHART_IS_ERRORS_Y:
        for (size_t i = 0; i < series.x.size(); i++) {
            add_error(xy, s, series, i);
        }
        break;
    }
}

void hide_axis(vtkAxis *axis, double beyond)
{
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(-beyond, 1.0 + beyond);
    axis->SetAxisVisible(false);
    axis->SetGridVisible(false);
    axis->SetLabelsVisible(false);
    axis->SetTicksVisible(false);
    axis->SetTitleVisible(false);
}

/// Whether nothing leaves the axes: then dots on their ends may be seen whole.
bool all_inside(const pm_chart *chart)
{
    auto outside = [](const pm_chart_axis &axis, double v) {
        double at = axis.at(v);
        return at < -1e-9 || at > 1.0 + 1e-9;
    };
    for (const pm_chart_series &s : chart->series) {
        bool turned = s.kind == PM_CHART_IS_ERRORS_X;
        for (size_t i = 0; i < s.x.size(); i++) {
            const pm_chart_axis &along = turned ? chart->x : chart->y;
            if (outside(turned ? chart->y : chart->x, s.x[i]) || outside(along, s.high[i]) ||
                (!s.low.empty() && outside(along, s.low[i]))) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

void pm_chart_draw_data(const pm_chart_sheet &s)
{
    double beyond = all_inside(s.chart) ? s.pixels(pm_chart_marker_size) : 0.0;
    vtkNew<vtkChartXY> xy;
    xy->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
    xy->SetSize(vtkRectf(static_cast<float>(s.left - beyond),
                         static_cast<float>(s.bottom - beyond),
                         static_cast<float>(s.width + 2.0 * beyond),
                         static_cast<float>(s.height + 2.0 * beyond)));
    hide_axis(xy->GetAxis(vtkAxis::BOTTOM), beyond / s.width);
    hide_axis(xy->GetAxis(vtkAxis::LEFT), beyond / s.height);
    for (const pm_chart_series &series : s.chart->series) {
        add_series(xy, s, series);
    }
    vtkNew<vtkContextActor> actor;
    actor->GetScene()->AddItem(xy);
    s.figure->page->AddActor(actor);
}
