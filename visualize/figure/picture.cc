// 8-bit pictures on a figure, pixel for pixel: no scaling, no filter, no colour conversion.
#include "figure.hh"

#include <vtkActor2D.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkNew.h>
#include <vtkProperty2D.h>

#include <algorithm>

namespace {

/// VTK counts rows from the bottom.
vtkSmartPointer<vtkImageData> turn_upward(const uint8_t *pixels, int width, int height)
{
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(width, height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    size_t row = 3 * static_cast<size_t>(width);
    for (int y = 0; y < height; y++) {
        const uint8_t *from = pixels + row * static_cast<size_t>(height - 1 - y);
        std::copy(from, from + row, static_cast<uint8_t *>(image->GetScalarPointer(0, y, 0)));
    }
    return image;
}

} // namespace

pm_status pm_figure_picture(pm_figure *figure, const uint8_t *pixels, int width, int height,
                            int x, int y)
{
    return pm_figure_guard("a picture", [&] {
        vtkNew<vtkImageMapper> mapper;
        mapper->SetInputData(turn_upward(pixels, width, height));
        mapper->SetColorWindow(255.0); // values as they are
        mapper->SetColorLevel(127.5);
        vtkNew<vtkActor2D> actor;
        actor->SetMapper(mapper);
        actor->SetPosition(x, figure->height - y - height);
        figure->page->AddActor2D(actor);
        return PM_OK;
    });
}
