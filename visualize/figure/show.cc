// A window to look around in. The figure's own window, opened hidden on the X display, is shown
// and handed to an interactor.
#include "figure.hh"

#include "look_around.hh"

#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>

VTK_MODULE_INIT(vtkInteractionStyle)
VTK_MODULE_INIT(vtkRenderingUI)

namespace {

const unsigned long interrupt_every = 100; // ms between questions for SIGINT

void prepare(vtkObject * /*window*/, unsigned long /*event*/, void *look, void * /*data*/)
{
    static_cast<pm_look_around *>(look)->prepare();
}

void redraw(vtkObject *interactor, unsigned long /*event*/, void * /*look*/, void * /*data*/)
{
    static_cast<vtkRenderWindowInteractor *>(interactor)->Render();
}

pm_status run(pm_figure *figure, const char *title, pm_vec3 center)
{
    vtkNew<pm_look_around> look;
    look->take(figure, center);
    vtkNew<vtkCallbackCommand> before;
    before->SetCallback(prepare);
    before->SetClientData(look);
    vtkNew<vtkCallbackCommand> resized;
    resized->SetCallback(redraw);
    vtkNew<vtkRenderWindowInteractor> hand;
    figure->window->SetOffScreenRendering(0);
    figure->window->AddObserver(vtkCommand::StartEvent, before);
    hand->SetRenderWindow(figure->window);
    hand->SetInteractorStyle(look);
    hand->AddObserver(vtkCommand::ConfigureEvent, resized);
    hand->Initialize();
    hand->CreateRepeatingTimer(interrupt_every);
    figure->window->Render();
    figure->window->SetWindowName(title); // now it hears keys
    hand->Start();
    hand->SetInteractorStyle(nullptr);
    figure->window->RemoveObserver(before);
    figure->window->SetInteractor(nullptr);
    return look->outcome;
}

} // namespace

pm_status pm_figure_show(pm_figure *figure, const char *title, pm_vec3 center)
{
    return pm_figure_guard("a window", [&] { return run(figure, title, center); });
}
