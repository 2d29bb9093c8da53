// A chart on the page: what stands where, and the grid with its labels.
#include "chart.hh"
#include "drawing.hh"
#include "words.hh"

#include <algorithm>
#include <cmath>

namespace {

// Pixels of a figure 900 high.
const double least_size = 15.0;
const double row_height = 20.0; // of names under bars
const pm_colour grid_colour = {62, 67, 80};
const pm_colour minor_colour = {40, 44, 56};
const pm_colour axis_colour = {150, 155, 168};
const pm_colour words_colour = {200, 204, 214};

void paint(vtkTextProperty *style, pm_colour c)
{
    style->SetColor(c.r / 255.0, c.g / 255.0, c.b / 255.0);
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
std::vector<pm_chart_tick> choose_x_ticks(const pm_chart_sheet &s)
{
    std::vector<pm_chart_tick> ticks = s.chart->x.ticks(s.pixels(70.0) / s.width);
    double need = widest(ticks, s.pixels(pm_chart_label_size)) + s.pixels(14.0);
    return need > s.pixels(70.0) ? s.chart->x.ticks(need / s.width) : ticks;
}

/// Whether names under bars touch each other in letters of this size.
bool touch(const pm_chart_sheet &s, double size)
{
    double slot = s.width / (s.chart->x.high - s.chart->x.low);
    return !s.chart->x.names.empty() && widest(s.x_ticks, size) > slot - s.pixels(10.0);
}

bool in_two_rows(const pm_chart_sheet &s)
{
    return touch(s, s.pixels(least_size));
}

/// Leaves room around the plot for what stands there.
void lay_out(pm_chart_sheet *s, double top)
{
    const pm_rect &where = s->chart->where;
    bool titled = !s->chart->y.title.empty();
    double floor = s->figure->height - where.y - where.height;
    double under = (s->chart->x.title.empty() ? 34.0 : 64.0);
    s->bottom = std::round(floor + s->pixels(under));
    s->height = std::round(top - s->bottom);
    s->y_ticks = s->chart->y.ticks(s->pixels(44.0) / s->height);
    double beside =
        widest(s->y_ticks, s->pixels(pm_chart_label_size)) + s->pixels(titled ? 46.0 : 14.0);
    s->left = std::round(where.x + beside);
    s->width = std::round(where.x + where.width - s->pixels(20.0) - s->left);
    if (s->width < 16.0 || s->height < 16.0) {
        throw std::runtime_error("there is no room for a chart; ask for a larger --size");
    }
    s->x_ticks = choose_x_ticks(*s);
    if (in_two_rows(*s)) {
        s->bottom += std::round(s->pixels(row_height));
        s->height -= std::round(s->pixels(row_height));
        s->y_ticks = s->chart->y.ticks(s->pixels(44.0) / s->height);
    }
}

void draw_grid(const pm_chart_sheet &s)
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
void write_x_labels(const pm_chart_sheet &s)
{
    bool narrow = touch(s, s.pixels(pm_chart_label_size));
    double size = s.pixels(narrow ? least_size : pm_chart_label_size);
    for (size_t i = 0; i < s.x_ticks.size(); i++) {
        bool lower = in_two_rows(s) && i % 2 == 1;
        double drop = s.pixels(8.0) + (lower ? s.pixels(row_height) : 0.0);
        vtkTextProperty *style = pm_words_put(s.figure, s.x_ticks[i].text,
                                              s.px(s.x_ticks[i].at), s.bottom - drop, size);
        style->SetJustificationToCentered();
        paint(style, words_colour);
    }
}

void write_labels(const pm_chart_sheet &s)
{
    write_x_labels(s);
    for (const pm_chart_tick &tick : s.y_ticks) {
        vtkTextProperty *style = pm_words_put(s.figure, tick.text, s.left - s.pixels(9.0),
                                              s.py(tick.at), s.pixels(pm_chart_label_size));
        style->SetJustificationToRight();
        style->SetVerticalJustificationToCentered();
        paint(style, words_colour);
    }
}

void write_titles(const pm_chart_sheet &s)
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

std::vector<std::string> labels_of(const std::vector<pm_chart_tick> &ticks)
{
    std::vector<std::string> labels;
    for (const pm_chart_tick &tick : ticks) {
        if (!tick.text.empty()) {
            labels.push_back(tick.text);
        }
    }
    return labels;
}

pm_drawn_chart record(const pm_chart_sheet &s)
{
    const pm_chart &c = *s.chart;
    pm_rect plot = {static_cast<int>(s.left),
                    static_cast<int>(s.figure->height - s.bottom - s.height),
                    static_cast<int>(s.width), static_cast<int>(s.height)};
    return {c.heading,
            plot,
            c.x.low,
            c.x.high,
            c.y.low,
            c.y.high,
            c.x.log,
            c.y.log,
            labels_of(s.x_ticks),
            labels_of(s.y_ticks)};
}

} // namespace

pm_drawn_chart pm_chart_draw(const pm_chart *chart)
{
    pm_chart_sheet s = {chart, chart->figure, 0.0, 0.0, 0.0, 0.0, {}, {}};
    const pm_rect &where = chart->where;
    double top = s.figure->height - where.y;
    if (!chart->heading.empty()) {
        top -= s.pixels(pm_words_line);
    }
    std::vector<pm_chart_entry> legend = pm_chart_place_legend(
        s, where.x + s.pixels(4.0), where.x + where.width, top - s.pixels(14.0));
    lay_out(&s, legend.empty() ? top - s.pixels(8.0) : legend.back().y - s.pixels(24.0));
    draw_grid(s);
    pm_chart_draw_data(s);
    write_labels(s);
    write_titles(s);
    pm_chart_draw_legend(s, legend);
    pm_chart_draw_words(s);
    return record(s);
}
