// view shares: how many photons each light sends, beside how much power it has. Where the two
// bars are as high, every photon carries the same.
#include "chart.h"
#include "emission_report.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define SHOWN_MOST 8
#define BAR 0.34 // of the room that a light has
#define NAME_MAX 24

/// The strongest lights, in the report's order.
typedef struct {
    const pm_report_light *light[SHOWN_MOST];
    int count;
} choice;

static choice choose(const pm_emission_report *report)
{
    choice c = {.count = 0};
    for (int i = 0; i < report->count; i++) {
        int stronger = 0;
        for (int k = 0; k < report->count; k++) {
            double more = report->lights[k].power - report->lights[i].power;
            stronger += more > 0.0 || (more == 0.0 && k < i);
        }
        if (stronger < SHOWN_MOST) {
            c.light[c.count++] = &report->lights[i];
        }
    }
    return c;
}

static double percent(double part, double whole)
{
    return 100.0 * part / whole;
}

/// The value over each bar.
static pm_status write_values(pm_chart *chart, const double *x, const double *height, int count)
{
    for (int i = 0; i < count; i++) {
        char text[32];
        snprintf(text, sizeof text,
                 height[i] < 0.095 && height[i] > 0.0 ? "%.2g %%" : "%.3g %%", height[i]);
        PM_TRY(pm_chart_word(chart, x[i], height[i], text));
    }
    return PM_OK;
}

static pm_status draw_bars(pm_chart *chart, const pm_emission_report *report, const choice *c)
{
    double left[SHOWN_MOST];
    double right[SHOWN_MOST];
    double power[SHOWN_MOST];
    double photons[SHOWN_MOST];
    for (int i = 0; i < c->count; i++) {
        left[i] = i - 0.5 * BAR - 0.02;
        right[i] = i + 0.5 * BAR + 0.02;
        power[i] = percent(c->light[i]->power, report->power);
        photons[i] = percent((double)c->light[i]->photons, (double)report->photons);
    }
    PM_TRY(pm_chart_bars(chart, "share of the power", pm_colour_named(PM_COLOUR_ORANGE), left,
                         power, c->count, BAR));
    PM_TRY(pm_chart_bars(chart, "share of the photons", pm_colour_named(PM_COLOUR_SKY), right,
                         photons, c->count, BAR));
    PM_TRY(write_values(chart, left, power, c->count));
    return write_values(chart, right, photons, c->count);
}

static pm_status draw_chart(pm_view *view, const pm_emission_report *report, const choice *c)
{
    char names[SHOWN_MOST][NAME_MAX];
    const char *pointers[SHOWN_MOST];
    double most = 0.0;
    for (int i = 0; i < c->count; i++) {
        snprintf(names[i], sizeof names[i], "%s", c->light[i]->id);
        pointers[i] = names[i];
        most = fmax(most, percent(c->light[i]->power, report->power));
        most = fmax(most, percent((double)c->light[i]->photons, (double)report->photons));
    }
    pm_chart_axes axes = {.x_title = "light",
                          .y_title = "share of all lights [%]",
                          .x_low = -0.6,
                          .x_high = c->count - 0.4,
                          .y_high = fmin(1.12 * most, 110.0),
                          .x_names = pointers,
                          .x_name_count = c->count};
    pm_rect room = pm_figure_wide_room(view->figure);
    pm_chart *chart;
    PM_TRY(pm_chart_open(view->figure, &room, &axes, &chart));
    PM_TRY(draw_bars(chart, report, c));
    return pm_chart_close(chart);
}

static void write_note(pm_view *view, const pm_emission_report *report, const choice *c)
{
    char count[PM_VIEW_GROUPED_MAX];
    pm_view_note(view, "%s",
                 "where both bars are as high, a photon carries the same power whichever light "
                 "it is from\n");
    pm_view_note(view, "%s photons carry %.4g of %.4g W",
                 pm_view_grouped(report->photons, count), report->sent, report->power);
    if (report->cells > 0) {
        char lit[PM_VIEW_GROUPED_MAX];
        pm_view_note(view, "; aimed lights send only through %s of %s cells",
                     pm_view_grouped(report->active, lit),
                     pm_view_grouped(report->cells, count));
    }
    if (c->count < report->count) {
        pm_view_note(view, "; the %d strongest of %d lights", c->count, report->count);
    }
}

static void add_facts(pm_view *view, const pm_emission_report *report, const choice *c)
{
    json_t *lights = json_array();
    for (int i = 0; i < c->count; i++) {
        const pm_report_light *light = c->light[i];
        json_array_append_new(
            lights, json_pack("{s:s,s:I,s:f,s:f,s:f}", "id", light->id, "photons",
                              (json_int_t)light->photons, "power", light->power, "power_share",
                              percent(light->power, report->power), "photon_share",
                              percent((double)light->photons, (double)report->photons)));
    }
    pm_view_fact(view, "lights", lights);
}

static pm_status draw(pm_view *view)
{
    pm_emission_report report;
    PM_TRY(pm_emission_report_read(view->files[0], &report));
    choice c = choose(&report);
    view->drawn = (uint64_t)c.count;
    pm_status status = draw_chart(view, &report, &c);
    write_note(view, &report, &c);
    add_facts(view, &report, &c);
    pm_emission_report_free(&report);
    return status;
}

const pm_view_kind pm_view_shares = {
    .name = "shares",
    .files = "REPORT.json (emission --report)",
    .shows = "photons of each light against its power",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_NO_SCENE,
    .options = "",
    .title = "Photons are shared out by power",
    .draw = draw,
};
