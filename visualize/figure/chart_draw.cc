// A chart on the page: VTK's chart draws curves, dots and areas; the grid, labels and legend
// around it are ours.
//
// VTK is given places between 0 and 1 instead of values: it holds them as float, and its own
// logarithmic axes put the first picture's curves in the wrong place.
#include "chart.hh"
#include "drawing.hh"
#include "words.hh"

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

#include <algorithm>
#include <cmath>

VTK_MODULE_INIT(vtkRenderingContextOpenGL2)

namespace {

// Pixels of a figure 900 high.
const double label_size = 17.0;
const double least_size = 15.0;
const double line_width = 2.5;
const double marker_size = 11.0;
const double cap_width = 9.0; // of error bars
const double swatch_width = 26.0;
const pm_colour grid_colour = {62, 67, 80};
const pm_colour minor_colour = {40, 44, 56};
const pm_colour axis_colour = {150, 155, 168};
const pm_colour words_colour = {200, 204, 214};

/// A chart while it is drawn. Pixels are counted from the bottom left.
struct sheet {
    const pm_chart *chart;
    pm_figure *figure;
    double left, bottom, width, height; // of the rectangle between the axes
    std::vector<pm_chart_tick> x_ticks, y_ticks;
    double pixels(double at900) const
    {
        return figure->pixels(at900);
    }
    double px(double at) const
    {
        return left + at * width;
    }
    double py(double at) const
    {
        return bottom + at * height;
    }
};

void paint(vtkTextProperty *style, pm_colour c)
{
    style->SetColor(c.r / 255.0, c.g / 255.0, c.b / 255.0);
}

// --- where everything stands
// ------------------------------------------------------------------

struct legend_place {
    const pm_chart_series *series;
    double x, y; // left middle
};

/// Entries in rows from `left` on, the first row's middle at `top`; returns their places.
std::vector<legend_place> place_legend(const sheet &s, double left, double right, double top)
{
    std::vector<legend_place> places;
    double x = left;
    for (const pm_chart_series &series : s.chart->series) {
        if (series.label.empty()) {
            continue;
        }
        double width = s.pixels(swatch_width + 10.0) +
                       pm_words_width(series.label, s.pixels(label_size)) + s.pixels(26.0);
        if (x > left && x + width - s.pixels(26.0) > right) {
            x = left;
            top -= s.pixels(28.0);
        }
        places.push_back({&series, x, top});
        x += width;
    }
    return places;
}

double widest(const std::vector<pm_chart_tick> &ticks, double size)
{
    double most = 0.0;
    for (const pm_chart_tick &tick : ticks) {
        most = std::max(most, pm_words_width(tick.text, size));
    }
    return most;
}

/// Ticks of the x axis that do not touch: their labels are measured, then spaced anew.
std::vector<pm_chart_tick> choose_x_ticks(const sheet &s)
{
    std::vector<pm_chart_tick> ticks = s.chart->x.ticks(s.pixels(70.0) / s.width);
    double need = widest(ticks, s.pixels(label_size)) + s.pixels(14.0);
    return need > s.pixels(70.0) ? s.chart->x.ticks(need / s.width) : ticks;
}

/// Leaves room around the plot for what stands there.
void lay_out(sheet *s, double top)
{
    const pm_rect &where = s->chart->where;
    bool titled = !s->chart->y.title.empty();
    double floor = s->figure->height - where.y - where.height;
    double under = (s->chart->x.title.empty() ? 34.0 : 64.0);
    s->bottom = std::round(floor + s->pixels(under));
    s->height = std::round(top - s->bottom);
    s->y_ticks = s->chart->y.ticks(s->pixels(44.0) / s->height);
    double beside = widest(s->y_ticks, s->pixels(label_size)) + s->pixels(titled ? 46.0 : 14.0);
    s->left = std::round(where.x + beside);
    s->width = std::round(where.x + where.width - s->pixels(20.0) - s->left);
    if (s->width < 16.0 || s->height < 16.0) {
        throw std::runtime_error("there is no room for a chart; ask for a larger --size");
    }
    s->x_ticks = choose_x_ticks(*s);
}

// --- the frame
// --------------------------------------------------------------------------------

void draw_grid(const sheet &s)
{
    pm_drawing grid;
    for (const pm_chart_tick &tick : s.x_ticks) {
        if (s.chart->x.names.empty()) {
            grid.line(pm_vec(s.px(tick.at), s.bottom, 0), pm_vec(s.px(tick.at), s.py(1), 0),
                      tick.text.empty() ? minor_colour : grid_colour, 1.0);
        }
    }
    for (const pm_chart_tick &tick : s.y_ticks) {
        grid.line(pm_vec(s.left, s.py(tick.at), 0), pm_vec(s.px(1), s.py(tick.at), 0),
                  tick.text.empty() ? minor_colour : grid_colour, 1.0);
    }
    pm_figure_overlay(s.figure, grid.data(), 1.0);
    pm_drawing axes;
    axes.line(pm_vec(s.left, s.bottom, 0), pm_vec(s.px(1), s.bottom, 0), axis_colour, 1.0);
    axes.line(pm_vec(s.left, s.bottom, 0), pm_vec(s.left, s.py(1), 0), axis_colour, 1.0);
    pm_figure_overlay(s.figure, axes.data(), s.pixels(1.5));
}

/// Names under bars shrink, and then stand in two rows, rather than touch.
void write_x_labels(const sheet &s)
{
    double size = s.pixels(label_size);
    bool named = !s.chart->x.names.empty();
    double slot = named ? s.width / (s.chart->x.high - s.chart->x.low) : s.width;
    bool narrow = named && widest(s.x_ticks, size) > slot - s.pixels(10.0);
    if (narrow) {
        size = s.pixels(least_size);
    }
    bool rows = narrow && widest(s.x_ticks, size) > slot - s.pixels(10.0);
    for (size_t i = 0; i < s.x_ticks.size(); i++) {
        double drop = s.pixels(8.0) + (rows && i % 2 == 1 ? s.pixels(20.0) : 0.0);
        vtkTextProperty *style = pm_words_put(s.figure, s.x_ticks[i].text,
                                              s.px(s.x_ticks[i].at), s.bottom - drop, size);
        style->SetJustificationToCentered();
        paint(style, words_colour);
    }
}

void write_labels(const sheet &s)
{
    write_x_labels(s);
    for (const pm_chart_tick &tick : s.y_ticks) {
        vtkTextProperty *style = pm_words_put(s.figure, tick.text, s.left - s.pixels(9.0),
                                              s.py(tick.at), s.pixels(label_size));
        style->SetJustificationToRight();
        style->SetVerticalJustificationToCentered();
        paint(style, words_colour);
    }
}

void write_titles(const sheet &s)
{
    const pm_rect &where = s.chart->where;
    double floor = s.figure->height - where.y - where.height;
    double size = s.pixels(pm_words_size);
    if (!s.chart->heading.empty()) {
        pm_words_put(s.figure, s.chart->heading, where.x, s.figure->height - where.y, size)
            ->BoldOn();
    }
    pm_words_put(s.figure, s.chart->x.title, s.px(0.5), floor + s.pixels(27.0), size)
        ->SetJustificationToCentered();
    vtkTextProperty *upward =
        pm_words_put(s.figure, s.chart->y.title, where.x, s.py(0.5), size);
    upward->SetOrientation(90.0);
    upward->SetJustificationToCentered();
}

void draw_swatch(pm_drawing *drawing, const sheet &s, const legend_place &place)
{
    const pm_chart_series &series = *place.series;
    double w = s.pixels(swatch_width);
    bool fills = series.kind == PM_CHART_IS_BARS || series.kind == PM_CHART_IS_BAND;
    bool dots = series.look == PM_CHART_DOTS || series.look == PM_CHART_DIAMONDS;
    double half = s.pixels(fills ? 8.0 : 1.5);
    if (dots) {
        int sides = series.look == PM_CHART_DIAMONDS ? 4 : 24;
        std::vector<pm_vec3> rim;
        for (int i = 0; i < sides; i++) {
            double phi = 2.0 * PM_PI * i / sides;
            double r = s.pixels(0.55 * marker_size);
            rim.push_back(
                pm_vec(place.x + w / 2 + r * std::cos(phi), place.y + r * std::sin(phi), 0.0));
        }
        drawing->polygon(rim, series.colour, 1.0);
        return;
    }
    int pieces = series.look == PM_CHART_DASHES ? 2 : 1;
    for (int i = 0; i < pieces; i++) {
        double x0 = place.x + i * 0.6 * w;
        double x1 = pieces == 1 ? place.x + w : x0 + 0.4 * w;
        const pm_vec3 corner[4] = {pm_vec(x0, place.y - half, 0), pm_vec(x1, place.y - half, 0),
                                   pm_vec(x1, place.y + half, 0),
                                   pm_vec(x0, place.y + half, 0)};
        drawing->quad(corner, series.colour, series.kind == PM_CHART_IS_BAND ? 0.45 : 1.0);
    }
}

void draw_legend(const sheet &s, const std::vector<legend_place> &places)
{
    pm_drawing swatches;
    for (const legend_place &place : places) {
        draw_swatch(&swatches, s, place);
        pm_words_put(s.figure, place.series->label, place.x + s.pixels(swatch_width + 10.0),
                     place.y, s.pixels(label_size))
            ->SetVerticalJustificationToCentered();
    }
    pm_figure_overlay(s.figure, swatches.data(), 1.0);
}

// --- the data
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

void add_markers(vtkChartXY *xy, const sheet &s, const pm_chart_series &series)
{
    vtkNew<vtkPlotPoints> points;
    points->SetInputData(
        table_of({places_of(s.chart->x, series.x), places_of(s.chart->y, series.high)}), 0, 1);
    points->SetColor(series.colour.r, series.colour.g, series.colour.b, 255);
    points->SetMarkerStyle(series.look == PM_CHART_DOTS ? vtkPlotPoints::CIRCLE
                                                        : vtkPlotPoints::DIAMOND);
    points->SetMarkerSize(static_cast<float>(s.pixels(marker_size)));
    xy->AddPlot(points);
}

void add_curve(vtkChartXY *xy, const sheet &s, const pm_chart_series &series)
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
void add_bars(vtkChartXY *xy, const sheet &s, const pm_chart_series &series)
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
void add_error(vtkChartXY *xy, const sheet &s, const pm_chart_series &series, size_t i)
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

void add_series(vtkChartXY *xy, const sheet &s, const pm_chart_series &series)
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

void draw_data(const sheet &s)
{
    double beyond = all_inside(s.chart) ? s.pixels(marker_size) : 0.0;
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

} // namespace

pm_rect pm_chart_draw(const pm_chart *chart)
{
    sheet s = {chart, chart->figure, 0.0, 0.0, 0.0, 0.0, {}, {}};
    const pm_rect &where = chart->where;
    double top = s.figure->height - where.y;
    if (!chart->heading.empty()) {
        top -= s.pixels(pm_words_line);
    }
    std::vector<legend_place> legend =
        place_legend(s, where.x + s.pixels(4.0), where.x + where.width, top - s.pixels(14.0));
    lay_out(&s, legend.empty() ? top - s.pixels(8.0) : legend.back().y - s.pixels(24.0));
    draw_grid(s);
    draw_data(s);
    write_labels(s);
    write_titles(s);
    draw_legend(s, legend);
    return {static_cast<int>(s.left), static_cast<int>(s.figure->height - s.bottom - s.height),
            static_cast<int>(s.width), static_cast<int>(s.height)};
}
