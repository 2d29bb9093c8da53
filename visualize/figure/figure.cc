// Opening a figure, its panels, and closing it.
//
// Multisampling is on and depth peeling off: with both on, Mesa's software renderer loses every
// translucent surface without a word. The page lies in a layer over all panels.
#include "figure.hh"

#include "drawing.hh"

#include <vtkActor2D.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTransform.h>

#include "window.hh"

#include <cmath>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace {

// The background, from the bottom to the top.
const pm_colour ground_low = {8, 9, 14};
const pm_colour ground_high = {30, 34, 48};

void point_camera(vtkCamera *camera, const pm_viewpoint &v)
{
    pm_vec3 at = pm_vec_add(v.position, v.forward);
    camera->SetPosition(v.position.x, v.position.y, v.position.z);
    camera->SetFocalPoint(at.x, at.y, at.z);
    camera->SetViewUp(v.up.x, v.up.y, v.up.z);
    camera->SetViewAngle(2.0 * std::atan(v.tan_y) * 180.0 / PM_PI);
    camera->SetWindowCenter(v.shift_x, v.shift_y);
    if (pm_vec_dot(pm_vec_cross(v.forward, v.up), v.right) < 0.0) {
        vtkNew<vtkTransform> mirror;
        mirror->Scale(-1.0, 1.0, 1.0);
        camera->SetUserViewTransform(mirror);
    }
}

pm_status check_size(int width, int height)
{
    int least = width < height ? width : height;
    int most = width > height ? width : height;
    if (least < PM_FIGURE_SIZE_MIN || most > PM_FIGURE_SIZE_MAX) {
        return pm_status_fail(PM_EINPUT,
                              "view: --size must lie in %d..%d on each side, got %dx%d",
                              PM_FIGURE_SIZE_MIN, PM_FIGURE_SIZE_MAX, width, height);
    }
    return PM_OK;
}

uint8_t between(uint8_t low, uint8_t high, double up)
{
    return static_cast<uint8_t>(std::lround(low + up * (high - low)));
}

/// A piece of the background up to the top right corner, in pixels from the bottom left.
void cover(const pm_figure *figure, pm_drawing *drawing, double x0, double y0)
{
    double x1 = figure->width;
    double y1 = figure->height;
    double up = y0 / y1;
    pm_colour low = {between(ground_low.r, ground_high.r, up),
                     between(ground_low.g, ground_high.g, up),
                     between(ground_low.b, ground_high.b, up)};
    vtkIdType first = drawing->vertex(pm_vec(x0, y0, 0), low, 1.0);
    drawing->vertex(pm_vec(x1, y0, 0), low, 1.0);
    drawing->vertex(pm_vec(x1, y1, 0), ground_high, 1.0);
    drawing->vertex(pm_vec(x0, y1, 0), ground_high, 1.0);
    drawing->triangle(first, first + 1, first + 2);
    drawing->triangle(first, first + 2, first + 3);
}

/// Where text stands, nothing of the scene is seen: paths come from far above it.
void cover_margins(pm_figure *figure)
{
    pm_drawing margins;
    double line = figure->pixels(2.0); // an outline at the border stays whole
    cover(figure, &margins, 0.0, (1.0 - PM_VIEWPOINT_TOP) * figure->height + line);
    cover(figure, &margins, figure->column_left() - figure->pixels(8.0), 0.0);
    pm_figure_overlay(figure, margins.data(), 1.0);
}

void colour_ground(vtkRenderer *renderer)
{
    renderer->GradientBackgroundOn();
    renderer->SetBackground(ground_low.r / 255.0, ground_low.g / 255.0, ground_low.b / 255.0);
    renderer->SetBackground2(ground_high.r / 255.0, ground_high.g / 255.0,
                             ground_high.b / 255.0);
}

/// The ground is the lowest layer, the panels lie on it, and the page over them.
enum { LAYER_GROUND, LAYER_PANELS, LAYER_PAGE, LAYER_COUNT };

vtkSmartPointer<vtkRenderer> add_layer(vtkRenderWindow *window, int layer)
{
    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetUseDepthPeeling(0);
    renderer->SetLayer(layer);
    window->AddRenderer(renderer);
    return renderer;
}

pm_status open_empty(int width, int height, pm_figure **figure)
{
    PM_TRY(check_size(width, height));
    pm_figure_forget_faults();
    vtkSmartPointer<vtkRenderWindow> window;
    PM_TRY(pm_window_open(width, height, &window));
    window->SetMultiSamples(8);
    window->SetNumberOfLayers(LAYER_COUNT);
    colour_ground(add_layer(window, LAYER_GROUND));
    auto page = add_layer(window, LAYER_PAGE);
    *figure = new pm_figure{};
    (*figure)->width = width;
    (*figure)->height = height;
    (*figure)->window = window;
    (*figure)->page = page;
    (*figure)->renderer = page;
    (*figure)->column_top = (1.0 - PM_VIEWPOINT_TOP) * height;
    return PM_OK;
}

void add_panel(pm_figure *figure, const pm_rect &where, const pm_viewpoint &viewpoint)
{
    auto renderer = add_layer(figure->window, LAYER_PANELS);
    double width = figure->width;
    double height = figure->height;
    renderer->SetViewport(where.x / width, 1.0 - (where.y + where.height) / height,
                          (where.x + where.width) / width, 1.0 - where.y / height);
    point_camera(renderer->GetActiveCamera(), viewpoint);
    figure->renderer = renderer;
    figure->viewpoint = viewpoint;
    figure->panels.push_back({where, viewpoint, renderer});
}

} // namespace

void pm_figure_overlay(pm_figure *figure, vtkPolyData *data, double line_width)
{
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkCoordinate> pixels;
    pixels->SetCoordinateSystemToViewport();
    mapper->SetTransformCoordinate(pixels);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLineWidth(static_cast<float>(line_width));
    figure->page->AddActor2D(actor);
}

void pm_figure_keep(pm_figure *figure, const char *name, vtkPolyData *data)
{
    figure->datasets.push_back({name, data, figure->renderer});
}

void pm_figure_scenery(pm_figure *figure, const pm_scene *scene, vtkProp *prop)
{
    figure->renderer->AddViewProp(prop);
    figure->scenery.push_back(prop);
    figure->scene = scene;
}

void pm_figure_facing(pm_figure *figure, vtkActor *actor, const pm_drawn_for &draw)
{
    figure->renderer->AddActor(actor);
    figure->scenery.push_back(actor);
    figure->facing.push_back({actor, draw, figure->renderer});
}

pm_status pm_figure_open(const pm_viewpoint *viewpoint, pm_figure **figure)
{
    return pm_figure_guard("a figure", [&] {
        PM_TRY(open_empty(viewpoint->width, viewpoint->height, figure));
        add_panel(*figure, {0, 0, viewpoint->width, viewpoint->height}, *viewpoint);
        cover_margins(*figure);
        return PM_OK;
    });
}

pm_status pm_figure_open_flat(int width, int height, pm_figure **figure)
{
    return pm_figure_guard("a figure", [&] { return open_empty(width, height, figure); });
}

pm_status pm_figure_panel(pm_figure *figure, const pm_rect *where,
                          const pm_viewpoint *viewpoint)
{
    return pm_figure_guard("a panel", [&] {
        add_panel(figure, *where, *viewpoint);
        return PM_OK;
    });
}

void pm_figure_close(pm_figure *figure)
{
    delete figure;
}
