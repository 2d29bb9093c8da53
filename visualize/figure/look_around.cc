// A press that hardly moves is a click, which asks what is there; one that moves turns the
// panel it began in.
#include "look_around.hh"

#include "drawing.hh"
#include "pick.hh"

extern "C" {
#include "interrupt.h"
#include "png.h"
}

#include <vtkObjectFactory.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkTextProperty.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

namespace {

const int still = 4;             // pixels that a click may move
const double nearer = 0.87;      // a notch of the wheel
const size_t line_most = 96;     // letters of the status line before it is broken
const double status_size = 17.0; // pixels of a figure 900 high
const int saved_most = 9999;

const double ring_radius = 10.0;

const char help_text[] = "drag: turn\n"
                         "wheel: nearer, farther\n"
                         "right or middle drag: move\n"
                         "click: what is here?\n"
                         "r: as it was\n"
                         "l: scene and labels off, on\n"
                         "s: save a PNG\n"
                         "h: this help off, on\n"
                         "q, Esc: close";

void dress(vtkTextActor *words, pm_figure *figure, double size)
{
    vtkTextProperty *style = words->GetTextProperty();
    style->SetFontFamilyToArial();
    style->SetFontSize(static_cast<int>(std::lround(figure->pixels(size))));
    style->SetColor(0.93, 0.94, 0.96);
    style->SetBackgroundColor(0.06, 0.07, 0.1);
    style->SetBackgroundOpacity(0.85);
    style->SetLineSpacing(1.25);
    figure->page->AddActor2D(words);
}

void make_ring(vtkActor2D *actor, pm_figure *figure)
{
    const int sides = 32;
    pm_drawing circle;
    std::vector<pm_vec3> rim;
    for (int i = 0; i < sides; i++) {
        double phi = 2.0 * PM_PI * i / sides;
        double r = figure->pixels(ring_radius);
        rim.push_back(pm_vec(r * std::cos(phi), r * std::sin(phi), 0.0));
    }
    circle.outline(rim, pm_colour_named(PM_COLOUR_WHITE), 1.0);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(circle.data());
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLineWidth(static_cast<float>(figure->pixels(2.0)));
    actor->SetVisibility(0);
    figure->page->AddActor2D(actor);
}

/// A line of text broken at blanks.
std::string broken(const std::string &line)
{
    std::string text;
    size_t start = 0;
    while (line.size() - start > line_most) {
        size_t blank = line.rfind(' ', start + line_most);
        if (blank == std::string::npos || blank <= start) {
            break;
        }
        text += line.substr(start, blank - start) + "\n";
        start = blank + 1;
    }
    return text + line.substr(start);
}

} // namespace

pm_look_around *pm_look_around::New()
{
    VTK_STANDARD_NEW_BODY(pm_look_around);
}

void pm_look_around::take(pm_figure *of, pm_vec3 added)
{
    figure = of;
    center = added;
    for (const pm_panel &panel : figure->panels) {
        orbits.push_back(std::make_unique<pm_orbit>(panel));
    }
    double margin = figure->pixels(16.0);
    status->SetInput("h: help");
    dress(status, figure, status_size);
    status->SetPosition(margin, margin);
    help->SetInput(help_text);
    dress(help, figure, status_size + 2.0);
    help->SetPosition(margin, figure->height / 3.0);
    help->SetVisibility(0);
    layout = std::make_unique<pm_page_layout>(figure);
    make_ring(ring, figure);
}

void pm_look_around::prepare()
{
    for (auto &orbit : orbits) {
        orbit->fit();
    }
    layout->resize();
    layout->follow();
    double at[2] = {0.0, 0.0};
    ring->SetVisibility(
        static_cast<int>(picked_in != nullptr && pm_page_place(picked_in, picked, at)));
    ring->SetPosition(at[0], at[1]);
}

void pm_look_around::redraw()
{
    figure->window->Render();
}

void pm_look_around::stop(pm_status why)
{
    outcome = why;
    Interactor->TerminateApp();
}

void pm_look_around::tell(const std::string &line)
{
    status->SetInput(broken(line).c_str());
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
}

pm_orbit *pm_look_around::orbit_at(const int at[2])
{
    for (auto &orbit : orbits) {
        vtkRenderer *renderer = orbit->panel.renderer;
        int x = at[0] - renderer->GetOrigin()[0];
        int y = at[1] - renderer->GetOrigin()[1];
        if (x >= 0 && y >= 0 && x < renderer->GetSize()[0] && y < renderer->GetSize()[1]) {
            return orbit.get();
        }
    }
    return nullptr;
}

void pm_look_around::begin(drag how)
{
    const int *at = Interactor->GetEventPosition();
    for (int i = 0; i < 2; i++) {
        pressed[i] = at[i];
        last[i] = at[i];
    }
    held = orbit_at(at);
    dragging = how;
    moved = false;
}

void pm_look_around::end()
{
    dragging = DRAG_NONE;
    held = nullptr;
}

void pm_look_around::OnMouseMove()
{
    const int *at = Interactor->GetEventPosition();
    moved = moved || std::abs(at[0] - pressed[0]) + std::abs(at[1] - pressed[1]) > still;
    if (dragging == DRAG_NONE || held == nullptr || !moved) {
        return;
    }
    if (dragging == DRAG_TURN) {
        held->turn(at[0] - last[0], at[1] - last[1]);
    } else {
        held->shift(at[0] - last[0], at[1] - last[1]);
    }
    last[0] = at[0];
    last[1] = at[1];
    redraw();
}

void pm_look_around::OnLeftButtonDown()
{
    begin(DRAG_TURN);
}

void pm_look_around::OnLeftButtonUp()
{
    bool click = dragging == DRAG_TURN && !moved;
    end();
    if (click) {
        pick();
    }
}

void pm_look_around::OnMiddleButtonDown()
{
    begin(DRAG_SHIFT);
}

void pm_look_around::OnMiddleButtonUp()
{
    end();
}

void pm_look_around::OnRightButtonDown()
{
    begin(DRAG_SHIFT);
}

void pm_look_around::OnRightButtonUp()
{
    end();
}

void pm_look_around::zoom(double factor)
{
    pm_orbit *orbit = orbit_at(Interactor->GetEventPosition());
    if (orbit != nullptr) {
        orbit->approach(factor);
        redraw();
    }
}

void pm_look_around::OnMouseWheelForward()
{
    zoom(nearer);
}

void pm_look_around::OnMouseWheelBackward()
{
    zoom(1.0 / nearer);
}

void pm_look_around::pick()
{
    const int *at = Interactor->GetEventPosition();
    const pm_orbit *orbit = orbit_at(at);
    vtkRenderer *in = orbit != nullptr ? orbit->panel.renderer.GetPointer() : nullptr;
    pm_pick found = {"", picked};
    if (in != nullptr) {
        found = pm_pick_at(figure, in, at[0], at[1], center);
    } else {
        found.text = pm_pick_on_chart(figure, at[0], at[1]);
    }
    picked = found.at;
    picked_in = found.text.empty() ? nullptr : in;
    tell(found.text.empty() ? "nothing is here" : found.text);
    redraw();
}

/// Numbered, and never over a file that is there.
void pm_look_around::save()
{
    char path[32];
    int number = 1;
    do {
        std::snprintf(path, sizeof path, "view-%03d.png", number);
    } while (access(path, F_OK) == 0 && ++number <= saved_most);
    status->SetVisibility(0);
    uint8_t *pixels = nullptr;
    const int *size = figure->window->GetSize();
    pm_status result = pm_figure_pixels(figure, &pixels);
    if (result == PM_OK) {
        result = pm_png_write_bytes(path, pixels, size[0], size[1]);
    }
    std::free(pixels);
    status->SetVisibility(1);
    tell(result == PM_OK ? std::string("saved ") + path
                         : std::string("not saved: ") + pm_status_message());
    pm_status_clear();
    redraw();
}

void pm_look_around::toggle_scenery()
{
    layout->marks_shown = !layout->marks_shown;
    for (vtkProp *prop : figure->scenery) {
        prop->SetVisibility(static_cast<int>(layout->marks_shown));
    }
}

void pm_look_around::OnKeyPress()
{
    const char *name = Interactor->GetKeySym();
    std::string key = name != nullptr ? name : "";
    if (key == "q" || key == "Escape") {
        stop(PM_OK);
    } else if (key == "s") {
        save();
    } else if (key == "r") {
        for (auto &orbit : orbits) {
            orbit->reset();
        }
        redraw();
    } else if (key == "l") {
        toggle_scenery();
        redraw();
    } else if (key == "h") {
        help->SetVisibility(help->GetVisibility() == 0);
        redraw();
    }
}

void pm_look_around::OnKeyRelease()
{
}

void pm_look_around::OnChar()
{
}

void pm_look_around::OnTimer()
{
    if (pm_interrupted()) {
        stop(pm_interrupt_check());
    }
}
