// What stands where on a figure, for programs that look up pixels.
#include "figure.hh"

namespace {

json_t *vector_json(pm_vec3 v)
{
    return json_pack("[f,f,f]", v.x, v.y, v.z);
}

json_t *panel_json(const pm_panel &panel, pm_vec3 center)
{
    const pm_viewpoint &v = panel.viewpoint;
    json_t *camera =
        json_pack("{s:o,s:o,s:o,s:o,s:[f,f],s:[f,f]}", "position",
                  vector_json(pm_vec_add(v.position, center)), "right", vector_json(v.right),
                  "up", vector_json(v.up), "forward", vector_json(v.forward), "tan", v.tan_x,
                  v.tan_y, "shift", v.shift_x, v.shift_y);
    return json_pack("{s:i,s:i,s:i,s:i,s:o}", "x", panel.where.x, "y", panel.where.y, "width",
                     panel.where.width, "height", panel.where.height, "camera", camera);
}

json_t *scale_json(const pm_drawn_scale &scale)
{
    return json_pack("{s:s,s:f,s:f,s:b,s:i,s:i,s:i,s:i}", "heading", scale.heading.c_str(),
                     "low", scale.low, "high", scale.high, "logarithmic",
                     static_cast<int>(scale.logarithmic), "x", scale.where.x, "y",
                     scale.where.y, "width", scale.where.width, "height", scale.where.height);
}

json_t *labels_json(const std::vector<std::string> &labels)
{
    json_t *all = json_array();
    for (const std::string &label : labels) {
        json_array_append_new(all, json_string(label.c_str()));
    }
    return all;
}

json_t *chart_json(const pm_drawn_chart &chart)
{
    return json_pack("{s:s,s:i,s:i,s:i,s:i,s:[f,f],s:[f,f],s:b,s:b,s:o,s:o}", "heading",
                     chart.heading.c_str(), "x", chart.where.x, "y", chart.where.y, "width",
                     chart.where.width, "height", chart.where.height, "x_ends", chart.x_low,
                     chart.x_high, "y_ends", chart.y_low, chart.y_high, "x_log",
                     static_cast<int>(chart.x_log), "y_log", static_cast<int>(chart.y_log),
                     "x_labels", labels_json(chart.x_labels), "y_labels",
                     labels_json(chart.y_labels));
}

} // namespace

json_t *pm_figure_json(const pm_figure *figure, pm_vec3 center)
{
    json_t *panels = json_array();
    json_t *scales = json_array();
    json_t *charts = json_array();
    for (const pm_panel &panel : figure->panels) {
        json_array_append_new(panels, panel_json(panel, center));
    }
    for (const pm_drawn_scale &scale : figure->scales) {
        json_array_append_new(scales, scale_json(scale));
    }
    for (const pm_drawn_chart &chart : figure->charts) {
        json_array_append_new(charts, chart_json(chart));
    }
    return json_pack("{s:[i,i],s:o,s:o,s:o}", "size", figure->width, figure->height, "panels",
                     panels, "scales", scales, "charts", charts);
}
