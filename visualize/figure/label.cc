// Everything that is read: title, note, legend, scale, words in the scene. Laid out in pixels
// of a picture 900 high and scaled with it, so that it is legible at any size.
#include "drawing.hh"
#include "figure.hh"
#include "words.hh"

#include <vtkNew.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <cmath>
#include <cstdio>

namespace {

const double title_size = 28.0;
const double note_size = 19.0;
const double text_size = pm_words_size;
const double mark_size = 16.0;
const double line_height = pm_words_line;
const double swatch_width = 26.0;
const double bar_height = 190.0;
const int bar_steps = 128;

/// Letters of a `size` in a picture 900 pixels high.
vtkTextProperty *write(pm_figure *figure, const std::string &text, double x, double y,
                       double size)
{
    return pm_words_put(figure, text, x, y, figure->pixels(size));
}

void box(pm_drawing *drawing, double x0, double y0, double x1, double y1, pm_colour colour)
{
    const pm_vec3 corner[4] = {pm_vec(x0, y0, 0), pm_vec(x1, y0, 0), pm_vec(x1, y1, 0),
                               pm_vec(x0, y1, 0)};
    drawing->quad(corner, colour, 1.0);
}

void disc(pm_drawing *drawing, double x, double y, double radius, pm_colour colour)
{
    const int sides = 24;
    std::vector<pm_vec3> rim;
    for (int i = 0; i < sides; i++) {
        double phi = 2.0 * PM_PI * i / sides;
        rim.push_back(pm_vec(x + radius * std::cos(phi), y + radius * std::sin(phi), 0.0));
    }
    drawing->polygon(rim, colour, 1.0);
}

/// One swatch whose middle is at height `y`.
void swatch(const pm_figure *figure, pm_drawing *drawing, const pm_legend_entry &entry,
            double x, double y)
{
    double w = figure->pixels(swatch_width);
    double h = figure->pixels(9.0);
    switch (entry.swatch) {
    case PM_SWATCH_FILL:
        box(drawing, x, y - h, x + w, y + h, entry.colour);
        break;
    case PM_SWATCH_LINE:
        box(drawing, x, y - h / 5, x + w, y + h / 5, entry.colour);
        break;
    case PM_SWATCH_DOT:
        disc(drawing, x + w / 2, y, h * 0.75, entry.colour);
        break;
    case PM_SWATCH_NONE:
        break;
    }
}

/// The heading of a block; returns the height where its content starts.
double begin_block(pm_figure *figure, const char *heading)
{
    double top = figure->column_top;
    write(figure, heading, figure->column_left(), top, text_size)->BoldOn();
    int lines = 1;
    for (const char *c = heading; *c != '\0'; c++) {
        lines += *c == '\n';
    }
    return top - figure->pixels(line_height) * lines;
}

struct tick {
    double position; // on the bar, 0 to 1
    std::string text;
};

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// Both ends, with their own values, and between them 1, 2, 5 times a power of ten where there
/// is room.
std::vector<tick> choose_ticks(const pm_scale *s)
{
    std::vector<tick> ticks = {{0.0, number(s->low)}, {1.0, number(s->high)}};
    if (!s->logarithmic) {
        ticks.push_back({0.5, number(0.5 * (s->low + s->high))});
        return ticks;
    }
    const double room = 0.09;
    double range = std::log10(s->high / s->low);
    const double all[] = {1.0, 2.0, 5.0};
    const double decades[] = {1.0};
    bool dense = 3.0 * range < 0.9 / room;
    const double *steps = dense ? all : decades;
    double last = 0.0;
    for (int e = static_cast<int>(std::floor(std::log10(s->low))); e <= std::log10(s->high);
         e++) {
        for (int i = 0; i < (dense ? 3 : 1); i++) {
            double value = steps[i] * std::pow(10.0, e);
            double at = std::log10(value / s->low) / range;
            if (at - last >= room && at <= 1.0 - room) {
                ticks.push_back({at, number(value)});
                last = at;
            }
        }
    }
    return ticks;
}

/// A rectangle given by its top left corner, from the figure's bottom left.
pm_rect on_page(const pm_figure *figure, double x, double top, double width, double height)
{
    return {static_cast<int>(std::lround(x)),
            static_cast<int>(std::lround(figure->height - top)),
            static_cast<int>(std::lround(width)), static_cast<int>(std::lround(height))};
}

} // namespace

vtkTextProperty *pm_words_put(pm_figure *figure, const std::string &text, double x, double y,
                              double size)
{
    return pm_words_actor(figure, text, x, y, size)->GetTextProperty();
}

vtkTextActor *pm_words_actor(pm_figure *figure, const std::string &text, double x, double y,
                             double size)
{
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text.c_str());
    actor->SetPosition(x, y);
    vtkTextProperty *style = actor->GetTextProperty();
    style->SetFontFamilyToArial();
    style->SetFontSize(static_cast<int>(std::lround(size)));
    style->SetColor(0.93, 0.94, 0.96);
    style->SetVerticalJustificationToTop();
    style->SetLineSpacing(1.25);
    figure->page->AddActor2D(actor);
    return actor; // the page holds it
}

double pm_words_width(const std::string &text, double size)
{
    vtkNew<vtkTextProperty> style;
    style->SetFontFamilyToArial();
    style->SetFontSize(static_cast<int>(std::lround(size)));
    int box[4] = {0, 0, 0, 0};
    const int dpi = 72;
    vtkTextRenderer::GetInstance()->GetBoundingBox(style, text, box, dpi);
    return text.empty() ? 0.0 : box[1] - box[0] + 1.0;
}

pm_status pm_figure_title(pm_figure *figure, const char *title, const char *note)
{
    return pm_figure_guard("a title", [&] {
        double x = figure->width * PM_VIEWPOINT_LEFT;
        double top = figure->height - figure->pixels(20.0);
        write(figure, title, x, top, title_size)->BoldOn();
        write(figure, note, x, top - figure->pixels(42.0), note_size)
            ->SetColor(0.72, 0.75, 0.8);
        return PM_OK;
    });
}

pm_status pm_figure_legend(pm_figure *figure, const char *heading,
                           const pm_legend_entry *entries, int count)
{
    return pm_figure_guard("a legend", [&] {
        double x = figure->column_left();
        double y = begin_block(figure, heading);
        pm_drawing swatches;
        for (int i = 0; i < count; i++) {
            bool alone = entries[i].swatch == PM_SWATCH_NONE;
            double indent = alone ? 0.0 : figure->pixels(swatch_width + 12.0);
            swatch(figure, &swatches, entries[i], x, y - figure->pixels(10.0));
            write(figure, entries[i].text, x + indent, y, text_size - (alone ? 2.0 : 0.0));
            y -= figure->pixels(line_height);
        }
        pm_figure_overlay(figure, swatches.data(), 1.0);
        figure->column_top = y - figure->pixels(16.0);
        return PM_OK;
    });
}

pm_status pm_figure_scale(pm_figure *figure, const pm_scale *scale)
{
    return pm_figure_guard("a scale", [&] {
        double x = figure->column_left();
        double top = begin_block(figure, scale->heading) - figure->pixels(10.0);
        double height = figure->pixels(bar_height);
        double w = figure->pixels(swatch_width);
        pm_drawing bar;
        for (int i = 0; i < bar_steps; i++) {
            double y = top - height + height * i / bar_steps;
            box(&bar, x, y, x + w, y + height / bar_steps,
                scale->colour((i + 0.5) / bar_steps));
        }
        for (const tick &t : choose_ticks(scale)) {
            double y = top - height * (1.0 - t.position);
            bar.line(pm_vec(x + w, y, 0), pm_vec(x + w + figure->pixels(7.0), y, 0),
                     pm_colour_named(PM_COLOUR_WHITE), 1.0);
            write(figure, t.text, x + w + figure->pixels(13.0), y, text_size - 1.0)
                ->SetVerticalJustificationToCentered();
        }
        pm_figure_overlay(figure, bar.data(), figure->pixels(1.5));
        figure->scales.push_back({scale->heading, scale->low, scale->high, scale->logarithmic,
                                  on_page(figure, x, top, w, height)});
        figure->column_top = top - height - figure->pixels(34.0);
        return PM_OK;
    });
}

pm_status pm_figure_mark(pm_figure *figure, pm_vec3 at, const char *text)
{
    return pm_figure_guard("a mark", [&] {
        double x = 0.0;
        double y = 0.0;
        const pm_rect &panel = figure->panels.back().where;
        bool before = pm_viewpoint_project(&figure->viewpoint, at, &x, &y);
        if (before && x >= 0.0 && y >= 0.0 && x <= panel.width && y <= panel.height) {
            vtkTextActor *words =
                pm_words_actor(figure, text, panel.x + x, figure->height - panel.y - y,
                               figure->pixels(mark_size));
            figure->marks.push_back({words, at, figure->renderer});
            vtkTextProperty *style = words->GetTextProperty();
            style->SetColor(0.85, 0.87, 0.92);
            style->SetBackgroundColor(0.06, 0.07, 0.1);
            style->SetBackgroundOpacity(0.8);
            style->SetJustificationToCentered();
            style->SetVerticalJustificationToCentered();
        }
        return PM_OK;
    });
}

pm_status pm_figure_text(pm_figure *figure, const char *text, double x, double y, double size,
                         pm_text_look look)
{
    return pm_figure_guard("a line of text", [&] {
        vtkTextProperty *style = pm_words_put(figure, text, x, figure->height - y, size);
        style->SetBold(look == PM_TEXT_STRONG);
        if (look == PM_TEXT_DIM || look == PM_TEXT_DIM_RIGHT) {
            style->SetColor(0.72, 0.75, 0.8);
        }
        if (look == PM_TEXT_DIM_RIGHT) {
            style->SetJustificationToRight();
        }
        return PM_OK;
    });
}

pm_status pm_figure_caption(pm_figure *figure, const pm_rect *under, const char *text)
{
    return pm_figure_text(figure, text, under->x, under->y - figure->pixels(line_height),
                          figure->pixels(text_size), PM_TEXT_STRONG);
}
