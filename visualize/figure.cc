// Opening, writing and closing a figure.
//
// Multisampling is on and depth peeling off: with both on, Mesa's software renderer loses every
// translucent surface without a word. VTK's messages are kept off standard error; its errors,
// if any, make the write fail.
#include "figure.hh"

#include "drawing.hh"

extern "C" {
#include "interrupt.h"
#include "png.h"
}

#include <vtkActor2D.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

#include "window.hh"

#include <cmath>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace {

// The background, from the bottom to the top.
const pm_colour ground_low = {8, 9, 14};
const pm_colour ground_high = {30, 34, 48};

/// Takes VTK's messages: remembers the first error, drops the rest.
class Listener : public vtkOutputWindow {
  public:
    static Listener *New();
    void DisplayText(const char * /*text*/) override
    {
    }
    void DisplayErrorText(const char *text) override
    {
        if (first.empty()) {
            first = text;
        }
    }
    void forget()
    {
        first.clear();
    }
    /// First line of the first error; empty when there was none.
    std::string fault() const
    {
        return first.substr(0, first.find('\n'));
    }

  private:
    std::string first;
};

Listener *Listener::New()
{
    VTK_STANDARD_NEW_BODY(Listener);
}

/// The listener in place, put there by the first figure.
Listener *listen()
{
    Listener *there = dynamic_cast<Listener *>(vtkOutputWindow::GetInstance());
    if (there == nullptr) {
        vtkNew<Listener> listener;
        vtkOutputWindow::SetInstance(listener);
        there = listener;
    }
    return there;
}

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

pm_status check_size(const pm_viewpoint *v)
{
    int least = v->width < v->height ? v->width : v->height;
    int most = v->width > v->height ? v->width : v->height;
    if (least < PM_FIGURE_SIZE_MIN || most > PM_FIGURE_SIZE_MAX) {
        return pm_status_fail(PM_EINPUT,
                              "view: --size must lie in %d..%d on each side, got %dx%d",
                              PM_FIGURE_SIZE_MIN, PM_FIGURE_SIZE_MAX, v->width, v->height);
    }
    return PM_OK;
}

/// The picture's pixels, rows from the top.
std::vector<uint8_t> read_pixels(vtkRenderWindow *window, int width, int height)
{
    vtkNew<vtkUnsignedCharArray> upward;
    window->GetPixelData(0, 0, width - 1, height - 1, 0, upward);
    size_t row = 3 * static_cast<size_t>(width);
    std::vector<uint8_t> pixels(row * static_cast<size_t>(height));
    if (static_cast<size_t>(upward->GetNumberOfValues()) != pixels.size()) {
        throw std::runtime_error("VTK hands back no pixels");
    }
    for (int y = 0; y < height; y++) {
        const unsigned char *from = upward->GetPointer(static_cast<vtkIdType>(row) * y);
        std::copy(from, from + row, &pixels[row * static_cast<size_t>(height - 1 - y)]);
    }
    return pixels;
}

uint8_t between(uint8_t low, uint8_t high, double up)
{
    return static_cast<uint8_t>(std::lround(low + up * (high - low)));
}

/// A piece of the background up to the top right corner, in pixels from the bottom left.
void cover(const pm_figure *figure, pm_drawing *drawing, double x0, double y0)
{
    double x1 = figure->viewpoint.width;
    double y1 = figure->viewpoint.height;
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
    cover(figure, &margins, 0.0, (1.0 - PM_VIEWPOINT_TOP) * figure->viewpoint.height + line);
    cover(figure, &margins, figure->column_left() - figure->pixels(8.0), 0.0);
    pm_figure_overlay(figure, margins.data(), 1.0);
}

pm_status open_empty(const pm_viewpoint &viewpoint, pm_figure **figure)
{
    PM_TRY(check_size(&viewpoint));
    listen()->forget();
    vtkSmartPointer<vtkRenderWindow> window;
    PM_TRY(pm_window_open(viewpoint.width, viewpoint.height, &window));
    window->SetMultiSamples(8);
    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetUseDepthPeeling(0);
    renderer->GradientBackgroundOn();
    renderer->SetBackground(ground_low.r / 255.0, ground_low.g / 255.0, ground_low.b / 255.0);
    renderer->SetBackground2(ground_high.r / 255.0, ground_high.g / 255.0,
                             ground_high.b / 255.0);
    window->AddRenderer(renderer);
    *figure =
        new pm_figure{viewpoint, window, renderer, (1.0 - PM_VIEWPOINT_TOP) * viewpoint.height};
    return PM_OK;
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
    figure->renderer->AddActor2D(actor);
}

pm_status pm_figure_open(const pm_viewpoint *viewpoint, pm_figure **figure)
{
    return pm_figure_guard("a figure", [&] {
        PM_TRY(open_empty(*viewpoint, figure));
        point_camera((*figure)->renderer->GetActiveCamera(), *viewpoint);
        cover_margins(*figure);
        return PM_OK;
    });
}

pm_status pm_figure_open_flat(int width, int height, pm_figure **figure)
{
    return pm_figure_guard("a figure", [&] {
        pm_viewpoint nowhere = {};
        nowhere.width = width;
        nowhere.height = height;
        return open_empty(nowhere, figure);
    });
}

pm_status pm_figure_write(pm_figure *figure, const char *path)
{
    return pm_figure_guard("a picture", [&] {
        figure->renderer->ResetCameraClippingRange();
        figure->window->Render();
        const pm_viewpoint &v = figure->viewpoint;
        std::vector<uint8_t> pixels = read_pixels(figure->window, v.width, v.height);
        std::string fault = listen()->fault();
        if (!fault.empty()) {
            return PM_FAIL(PM_ELIMIT, "VTK cannot draw this: %.200s", fault.c_str());
        }
        PM_TRY(pm_interrupt_check());
        return pm_png_write_bytes(path, pixels.data(), v.width, v.height);
    });
}

void pm_figure_close(pm_figure *figure)
{
    delete figure;
}
