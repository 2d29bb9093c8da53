// Words of a chart: its legend over the plot, and words beside points in it.
#include "chart.hh"
#include "drawing.hh"
#include "words.hh"

#include <algorithm>
#include <cmath>

namespace {

// Pixels of a figure 900 high.
const double swatch_width = 26.0;
const double row_height = 28.0;
const double between = 26.0; // entries
const double word_size = 15.0;
const double sample = 5.0; // along what words should not hide

void draw_swatch(pm_drawing *drawing, const pm_chart_sheet &s, const pm_chart_entry &place)
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
            double r = s.pixels(0.55 * pm_chart_marker_size);
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

/// A rectangle in pixels from the bottom left.
struct area {
    double x0, y0, x1, y1;

    bool holds(double x, double y) const
    {
        return x >= x0 && x <= x1 && y >= y0 && y <= y1;
    }
    bool meets(const area &other) const
    {
        return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
    }
};

using spots = std::vector<pm_vec3>;

void sample_line(const pm_chart_sheet &s, double x0, double y0, double x1, double y1,
                 spots *taken)
{
    double steps = std::ceil(std::hypot(x1 - x0, y1 - y0) / s.pixels(sample));
    for (double i = 0.0; i <= steps; i += 1.0) {
        double t = steps > 0.0 ? i / steps : 0.0;
        taken->push_back(pm_vec(x0 + t * (x1 - x0), y0 + t * (y1 - y0), 0.0));
    }
}

/// Places along everything that words should not lie on.
void sample_series(const pm_chart_sheet &s, const pm_chart_series &series, spots *taken)
{
    const pm_chart *chart = s.chart;
    bool dots = series.look == PM_CHART_DOTS || series.look == PM_CHART_DIAMONDS;
    for (size_t i = 0; i < series.x.size(); i++) {
        if (series.kind == PM_CHART_IS_ERRORS_X) {
            double y = s.py(chart->y.at(series.x[i]));
            sample_line(s, s.px(chart->x.at(series.low[i])), y,
                        s.px(chart->x.at(series.high[i])), y, taken);
            continue;
        }
        double x = s.px(chart->x.at(series.x[i]));
        double y = s.py(chart->y.at(series.high[i]));
        if (series.kind == PM_CHART_IS_ERRORS_Y) {
            sample_line(s, x, s.py(chart->y.at(series.low[i])), x, y, taken);
        } else if (i > 0 && series.kind == PM_CHART_IS_CURVE && !dots) {
            sample_line(s, s.px(chart->x.at(series.x[i - 1])),
                        s.py(chart->y.at(series.high[i - 1])), x, y, taken);
        } else {
            const int weight = 4; // a dot is worth more than a piece of a line
            taken->insert(taken->end(), weight, pm_vec(x, y, 0.0));
        }
    }
}

/// How much a word there would hide; beyond the plot is worst.
double cost(const pm_chart_sheet &s, const area &word, const spots &taken,
            const std::vector<area> &others)
{
    bool inside = word.x0 >= s.left && word.x1 <= s.px(1.0) + s.pixels(16.0) &&
                  word.y0 >= s.bottom && word.y1 <= s.py(1.0);
    double sum = inside ? 0.0 : 400.0;
    for (const pm_vec3 &spot : taken) {
        sum += word.holds(spot.x, spot.y) ? 1.0 : 0.0;
    }
    for (const area &other : others) {
        sum += word.meets(other) ? 200.0 : 0.0;
    }
    return sum;
}

/// Where a word of this size may stand beside (x, y): above and below first.
std::vector<area> candidates(const pm_chart_sheet &s, double x, double y, double width)
{
    double height = s.pixels(word_size + 4.0);
    std::vector<area> all;
    for (double away : {s.pixels(9.0), s.pixels(24.0)}) {
        const double side = 0.7 * away;
        const double corner[][2] = {
            {x - width / 2, y + away},     {x - width / 2, y - away - height},
            {x + side, y + side},          {x - side - width, y + side},
            {x + side, y - side - height}, {x - side - width, y - side - height},
            {x + away, y - height / 2},    {x - away - width, y - height / 2}};
        for (const double *at : corner) {
            all.push_back({at[0], at[1], at[0] + width, at[1] + height});
        }
    }
    return all;
}

void write_word(const pm_chart_sheet &s, const area &where, const std::string &text)
{
    vtkTextProperty *style = pm_words_put(s.figure, text, where.x0, 0.5 * (where.y0 + where.y1),
                                          s.pixels(word_size));
    style->SetVerticalJustificationToCentered();
    style->SetBackgroundColor(0.06, 0.07, 0.1);
    style->SetBackgroundOpacity(0.6);
}

} // namespace

std::vector<pm_chart_entry> pm_chart_place_legend(const pm_chart_sheet &s, double left,
                                                  double right, double top)
{
    std::vector<pm_chart_entry> places;
    double x = left;
    for (const pm_chart_series &series : s.chart->series) {
        if (series.label.empty()) {
            continue;
        }
        double width = s.pixels(swatch_width + 10.0) +
                       pm_words_width(series.label, s.pixels(pm_chart_label_size)) +
                       s.pixels(between);
        if (x > left && x + width - s.pixels(between) > right) {
            x = left;
            top -= s.pixels(row_height);
        }
        places.push_back({&series, x, top});
        x += width;
    }
    return places;
}

void pm_chart_draw_legend(const pm_chart_sheet &s, const std::vector<pm_chart_entry> &places)
{
    pm_drawing swatches;
    for (const pm_chart_entry &place : places) {
        draw_swatch(&swatches, s, place);
        pm_words_put(s.figure, place.series->label, place.x + s.pixels(swatch_width + 10.0),
                     place.y, s.pixels(pm_chart_label_size))
            ->SetVerticalJustificationToCentered();
    }
    pm_figure_overlay(s.figure, swatches.data(), 1.0);
}

void pm_chart_draw_words(const pm_chart_sheet &s)
{
    spots taken;
    std::vector<area> words;
    for (const pm_chart_series &series : s.chart->series) {
        sample_series(s, series, &taken);
    }
    for (const pm_chart_note &word : s.chart->words) {
        double width = pm_words_width(word.text, s.pixels(word_size));
        std::vector<area> all =
            candidates(s, s.px(s.chart->x.at(word.x)), s.py(s.chart->y.at(word.y)), width);
        auto cheaper = [&](const area &a, const area &b) {
            return cost(s, a, taken, words) < cost(s, b, taken, words);
        };
        area best = *std::min_element(all.begin(), all.end(), cheaper);
        write_word(s, best, word.text);
        words.push_back(best);
    }
}
