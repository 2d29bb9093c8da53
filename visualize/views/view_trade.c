// view trade: what a setting costs in time and leaves in error. Which points lie on the Pareto
// line is the file's word, and so is the slope: whoever wrote `trade` sees their own.
#include "trade_chart.h"
#include "trade_file.h"
#include "trade_names.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LISTED_MOST 16 // Pareto points that the right column has room for
#define TOLD_MOST 8    // of which time and error have a line of their own
#define LINE_LETTERS 36

typedef struct {
    pm_trade trade;
    pm_trade_groups groups;
} trades;

static int count_drawn(const pm_trade *trade)
{
    int count = 0;
    for (int i = 0; i < trade->point_count; i++) {
        count += pm_trade_drawable(&trade->point[i]);
    }
    return count;
}

static bool has_parts(const pm_trade *trade)
{
    for (int i = 0; i < trade->pareto_count; i++) {
        const pm_trade_point *p = &trade->point[trade->pareto[i]];
        if (p->split && pm_trade_drawable(p) && p->bias + p->variance > 0.0) {
            return true;
        }
    }
    return false;
}

static pm_status draw_charts(pm_view *view, const trades *t)
{
    pm_rect room = pm_figure_room(view->figure);
    if (!has_parts(&t->trade)) {
        return pm_trade_chart_errors(view->figure, &room, &t->trade, &t->groups);
    }
    pm_rect upper = room;
    pm_rect lower = room;
    upper.height = room.height * 3 / 5;
    lower.y += upper.height;
    lower.height -= upper.height;
    PM_TRY(pm_trade_chart_errors(view->figure, &upper, &t->trade, &t->groups));
    return pm_trade_chart_parts(view->figure, &lower, &t->trade);
}

/// Colours of the dots, and the line.
static pm_status explain(pm_view *view, const trades *t)
{
    pm_legend_entry entries[PM_TRADE_GROUPS_MAX + 1];
    const pm_trade_groups *groups = &t->groups;
    int count = 0;
    for (; count < groups->count; count++) {
        const char *text = groups->option != NULL ? groups->value[count] : "a setting";
        entries[count] = (pm_legend_entry){PM_SWATCH_DOT, pm_trade_chart_colour(count), text};
    }
    entries[count++] =
        (pm_legend_entry){PM_SWATCH_LINE, pm_colour_named(PM_COLOUR_WHITE), "Pareto line"};
    return pm_figure_legend(view->figure, groups->option != NULL ? groups->option : "dots",
                            entries, count);
}

typedef struct {
    char text[2 * LISTED_MOST + 2][PM_TRADE_WORD * 3];
    int count;
} lines;

static char *next_line(lines *l)
{
    return l->text[l->count++];
}

/// "3  photons 50k, gather 0", and below it "0.41 s, error 0.0912, 14 MB".
static void list_point(const pm_trade *trade, int number, lines *l)
{
    char name[LINE_LETTERS];
    char *numbers;
    const pm_trade_point *p = &trade->point[trade->pareto[number]];
    pm_trade_name(trade, trade->pareto[number], name, sizeof name);
    snprintf(next_line(l), sizeof l->text[0], "%d  %s", number + 1, name);
    if (trade->pareto_count > TOLD_MOST) {
        return;
    }
    numbers = next_line(l);
    int used = snprintf(numbers, sizeof l->text[0], "    %.3g s, error %.3g", p->seconds.mean,
                        sqrt(fmax(p->rel_mse.mean, 0.0)));
    if (p->peak_bytes > 0.0) {
        snprintf(numbers + used, sizeof l->text[0] - (size_t)used, ", %.0f MB",
                 p->peak_bytes / 1e6);
    }
}

static pm_status list_settings(pm_view *view, const pm_trade *trade)
{
    lines l = {.count = 0};
    pm_legend_entry entries[2 * LISTED_MOST + 2];
    int listed = trade->pareto_count < LISTED_MOST ? trade->pareto_count : LISTED_MOST;
    for (int i = 0; i < listed; i++) {
        list_point(trade, i, &l);
    }
    if (listed < trade->pareto_count) {
        snprintf(next_line(&l), sizeof l.text[0], "and %d more in the file",
                 trade->pareto_count - listed);
    }
    for (int i = 0; i < l.count; i++) {
        entries[i] =
            (pm_legend_entry){PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), l.text[i]};
    }
    return pm_figure_legend(view->figure, "settings on the line", entries, l.count);
}

/// Slopes by name, the measured one beside the predicted.
static pm_status list_slopes(pm_view *view, const pm_trade *trade)
{
    char text[PM_TRADE_SLOPES_MAX][PM_TRADE_WORD * 3];
    pm_legend_entry entries[PM_TRADE_SLOPES_MAX];
    int count = 0;
    for (int i = 0; i < trade->slope_count; i++) {
        const pm_trade_slope *s = &trade->slope[i];
        if (s->name[0] == '\0') {
            continue; // the note has it
        }
        int used = snprintf(text[count], sizeof text[0], "%s: %.3g", s->name, s->measured);
        if (s->has_predicted) {
            snprintf(text[count] + used, sizeof text[0] - (size_t)used, " (predicted %.3g)",
                     s->predicted);
        }
        entries[count] =
            (pm_legend_entry){PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), text[count]};
        count++;
    }
    return count > 0 ? pm_figure_legend(view->figure, "slopes of the error", entries, count)
                     : PM_OK;
}

static void write_slope(pm_view *view, const pm_trade *trade)
{
    for (int i = 0; i < trade->slope_count; i++) {
        if (trade->slope[i].name[0] == '\0') {
            double slope = trade->slope[i].measured;
            pm_view_note(view, "  Slope %.3g: ten times the time, %.3g of the error.", slope,
                         pow(10.0, slope));
        }
    }
}

static void write_note(pm_view *view, const pm_trade *trade, int drawn)
{
    pm_view_note(view,
                 "A dot is one setting, the mean of its runs; bars are one standard deviation "
                 "of a run. Left is faster, lower is better.\n");
    pm_view_note(view,
                 "%d setting%s, %d on the Pareto line: no other is both faster and better.",
                 trade->point_count, trade->point_count == 1 ? "" : "s", trade->pareto_count);
    if (drawn < trade->point_count) {
        pm_view_note(view, "  %d not drawn: error 0 or below.", trade->point_count - drawn);
    }
    write_slope(view, trade);
}

static void tell(pm_view *view, const trades *t)
{
    json_t *pareto = json_array();
    for (int i = 0; i < t->trade.pareto_count; i++) {
        char name[LINE_LETTERS];
        int index = t->trade.pareto[i];
        pm_trade_name(&t->trade, index, name, sizeof name);
        json_array_append_new(pareto, json_pack("{s:i,s:s}", "point", index, "name", name));
    }
    pm_view_fact(view, "points", json_integer(t->trade.point_count));
    pm_view_fact(view, "pareto", pareto);
    pm_view_fact(view, "coloured_by",
                 t->groups.option != NULL ? json_string(t->groups.option) : json_null());
}

static pm_status draw_trade(pm_view *view, trades *t)
{
    PM_TRY(pm_trade_file_read(view->files[0], &t->trade));
    int drawn = count_drawn(&t->trade);
    if (drawn == 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s: no point has an error above 0, so none has a place on a "
                              "logarithmic axis",
                              view->files[0]);
    }
    PM_TRY(pm_trade_group(&t->trade, &t->groups));
    PM_TRY(pm_view_open_page(view));
    PM_TRY(draw_charts(view, t));
    PM_TRY(explain(view, t));
    PM_TRY(list_settings(view, &t->trade));
    PM_TRY(list_slopes(view, &t->trade));
    view->drawn = (uint64_t)drawn;
    write_note(view, &t->trade, drawn);
    tell(view, t);
    return pm_view_finish(view);
}

static pm_status make(pm_view *view)
{
    trades t = {0};
    pm_status status = draw_trade(view, &t);
    pm_trade_groups_free(&t.groups);
    pm_trade_file_free(&t.trade);
    return status;
}

const pm_view_kind pm_view_trade = {
    .name = "trade",
    .files = "TRADE.json (tradeoff)",
    .shows = "error against time, and the settings worth their time",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_NO_SCENE,
    .options = "",
    .title = "Speed for accuracy",
    .make = make,
};
