// What stands on a page is told by its type: letters, drawings in pixels, pictures, charts.
#include "page_layout.hh"

#include <vtkCamera.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkPropCollection.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace {

const int least_letters = 6; // pixels

} // namespace

pm_page_layout::pm_page_layout(pm_figure *on) : figure(on), width(on->width), height(on->height)
{
    vtkPropCollection *props = figure->page->GetViewProps();
    vtkCollectionSimpleIterator at;
    props->InitTraversal(at);
    while (vtkProp *prop = props->GetNextProp(at)) {
        remember(prop);
    }
}

void pm_page_layout::remember(vtkProp *prop)
{
    if (auto *context = vtkContextActor::SafeDownCast(prop)) {
        for (unsigned i = 0; i < context->GetScene()->GetNumberOfItems(); i++) {
            auto *xy = vtkChartXY::SafeDownCast(context->GetScene()->GetItem(i));
            if (xy != nullptr) {
                charts.push_back({xy, xy->GetSize()});
            }
        }
    } else if (auto *actor = vtkActor2D::SafeDownCast(prop)) {
        remember_actor(actor);
    }
}

void pm_page_layout::remember_actor(vtkActor2D *actor)
{
    const double *at = actor->GetPosition();
    if (auto *text = vtkTextActor::SafeDownCast(actor)) {
        all_words.push_back({text, at[0], at[1], text->GetTextProperty()->GetFontSize()});
    } else if (auto *image = vtkImageMapper::SafeDownCast(actor->GetMapper())) {
        const int *size = image->GetInput()->GetDimensions();
        pictures.push_back({actor, image, at[0], at[1], static_cast<double>(size[0]),
                            static_cast<double>(size[1])});
    } else if (auto *flat = vtkPolyDataMapper2D::SafeDownCast(actor->GetMapper())) {
        drawings.push_back({flat->GetInput(), flat->GetInput()->GetPoints()});
    }
}

void pm_page_layout::resize()
{
    const int *size = figure->window->GetSize();
    if (size[0] == width && size[1] == height) {
        return;
    }
    width = size[0];
    height = size[1];
    double across = static_cast<double>(width) / figure->width;
    double up = static_cast<double>(height) / figure->height;
    scale(across, up, std::min(across, up));
    for (const chart &c : charts) {
        float x = static_cast<float>(across);
        float y = static_cast<float>(up);
        c.chart->SetSize(vtkRectf(x * c.where.GetX(), y * c.where.GetY(),
                                  x * c.where.GetWidth(), y * c.where.GetHeight()));
    }
}

void pm_page_layout::scale(double across, double up, double letters)
{
    for (const words &w : all_words) {
        w.actor->SetPosition(across * w.x, up * w.y);
        w.actor->GetTextProperty()->SetFontSize(
            std::max(least_letters, static_cast<int>(std::lround(letters * w.size))));
    }
    for (const drawing &d : drawings) {
        vtkNew<vtkPoints> scaled;
        scaled->DeepCopy(d.points);
        for (vtkIdType i = 0; i < scaled->GetNumberOfPoints(); i++) {
            const double *p = d.points->GetPoint(i);
            scaled->SetPoint(i, across * p[0], up * p[1], 0.0);
        }
        d.data->SetPoints(scaled);
    }
    for (const picture &p : pictures) {
        p.mapper->SetRenderToRectangle(1);
        p.actor->SetPosition(across * p.x, up * p.y);
        p.actor->GetPosition2Coordinate()->SetCoordinateSystemToViewport();
        p.actor->SetPosition2(letters * p.width, letters * p.height);
    }
}

bool pm_page_place(vtkRenderer *renderer, pm_vec3 at, double place[2])
{
    renderer->SetWorldPoint(at.x, at.y, at.z, 1.0);
    renderer->WorldToDisplay();
    double seen[3];
    renderer->GetDisplayPoint(seen);
    const int *origin = renderer->GetOrigin();
    const int *size = renderer->GetSize();
    for (int i = 0; i < 2; i++) {
        place[i] = seen[i];
        if (seen[i] < origin[i] || seen[i] > origin[i] + size[i]) {
            return false;
        }
    }
    return seen[2] > 0.0 && seen[2] < 1.0;
}

void pm_page_layout::follow()
{
    for (const pm_drawn_mark &mark : figure->marks) {
        double at[2];
        bool seen = pm_page_place(mark.renderer, mark.at, at);
        mark.words->SetPosition(at[0], at[1]);
        mark.words->SetVisibility(static_cast<int>(seen && marks_shown));
    }
    for (const pm_facing &facing : figure->facing) {
        double eye[3];
        facing.renderer->GetActiveCamera()->GetPosition(eye);
        auto *mapper = vtkPolyDataMapper::SafeDownCast(facing.actor->GetMapper());
        if (mapper != nullptr) {
            mapper->SetInputData(facing.draw(pm_vec(eye[0], eye[1], eye[2])));
        }
    }
}
