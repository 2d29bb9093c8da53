// From a figure to pixels and to a PNG. VTK's messages are kept off standard error; its errors,
// if any, make this fail.
#include "figure.hh"

extern "C" {
#include "interrupt.h"
#include "png.h"
}

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdlib>

namespace {

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
        vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // else it prints them as well
        vtkNew<Listener> listener;
        vtkOutputWindow::SetInstance(listener);
        there = listener;
    }
    return there;
}

/// VTK counts rows from the bottom, pictures from the top.
void read_pixels(pm_figure *figure, uint8_t *pixels)
{
    vtkNew<vtkUnsignedCharArray> upward;
    const int *size = figure->window->GetSize();
    figure->window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, upward);
    size_t row = 3 * static_cast<size_t>(size[0]);
    size_t rows = static_cast<size_t>(size[1]);
    if (static_cast<size_t>(upward->GetNumberOfValues()) != row * rows) {
        throw std::runtime_error("VTK hands back no pixels");
    }
    for (size_t y = 0; y < rows; y++) {
        const unsigned char *from = upward->GetPointer(static_cast<vtkIdType>(row * y));
        std::copy(from, from + row, pixels + row * (rows - 1 - y));
    }
}

pm_status render(pm_figure *figure, uint8_t *pixels)
{
    for (const pm_panel &panel : figure->panels) {
        panel.renderer->ResetCameraClippingRange();
    }
    figure->window->Render();
    read_pixels(figure, pixels);
    std::string fault = pm_figure_fault();
    return fault.empty() ? PM_OK
                         : PM_FAIL(PM_ELIMIT, "VTK cannot draw this: %.200s", fault.c_str());
}

} // namespace

void pm_figure_forget_faults()
{
    listen()->first.clear();
}

std::string pm_figure_fault()
{
    const std::string &first = listen()->first;
    return first.substr(0, first.find('\n'));
}

pm_status pm_figure_pixels(pm_figure *figure, uint8_t **pixels)
{
    const int *size = figure->window->GetSize(); // the figure's, unless someone resized it
    size_t bytes = 3 * static_cast<size_t>(size[0]) * static_cast<size_t>(size[1]);
    uint8_t *room = static_cast<uint8_t *>(std::malloc(bytes));
    if (room == nullptr) {
        return PM_FAIL(PM_ENOMEM, "no memory for %d x %d pixels", size[0], size[1]);
    }
    pm_status status = pm_figure_guard("a picture", [&] { return render(figure, room); });
    if (status != PM_OK) {
        std::free(room);
        return status;
    }
    *pixels = room;
    return PM_OK;
}

pm_status pm_figure_write(pm_figure *figure, const char *path)
{
    uint8_t *pixels = nullptr;
    PM_TRY(pm_figure_pixels(figure, &pixels));
    pm_status status = pm_interrupt_check();
    if (status == PM_OK) {
        status = pm_png_write_bytes(path, pixels, figure->width, figure->height);
    }
    std::free(pixels);
    return status;
}
