// The hand on a figure's window: mouse and keys.
#ifndef PM_LOOK_AROUND_HH
#define PM_LOOK_AROUND_HH

#include "figure.hh"
#include "orbit.hh"
#include "page_layout.hh"

#include <vtkActor2D.h>
#include <vtkInteractorStyle.h>
#include <vtkNew.h>
#include <vtkTextActor.h>

#include <memory>
#include <vector>

class pm_look_around : public vtkInteractorStyle {
  public:
    static pm_look_around *New();
    pm_look_around(const pm_look_around &) = delete;
    pm_look_around &operator=(const pm_look_around &) = delete;

    /// The figure must outlive this; `center` is added to what is told.
    void take(pm_figure *figure, pm_vec3 center);

    /// Before each drawing.
    void prepare();

    /// Why it ended: PM_OK when it was closed, else what failed.
    pm_status outcome = PM_OK;

    void OnMouseMove() override;
    void OnLeftButtonDown() override;
    void OnLeftButtonUp() override;
    void OnMiddleButtonDown() override;
    void OnMiddleButtonUp() override;
    void OnRightButtonDown() override;
    void OnRightButtonUp() override;
    void OnMouseWheelForward() override;
    void OnMouseWheelBackward() override;
    void OnKeyPress() override;
    void OnKeyRelease() override;
    void OnChar() override; // VTK's own keys mean other things
    void OnTimer() override;

  protected:
    pm_look_around() = default;
    ~pm_look_around() override = default;

  private:
    enum drag { DRAG_NONE, DRAG_TURN, DRAG_SHIFT };

    void begin(drag how);
    void end();
    void zoom(double factor);
    void pick();
    void save();
    void tell(const std::string &line);
    void toggle_scenery();
    void redraw();
    pm_orbit *orbit_at(const int at[2]);
    void stop(pm_status why);

    pm_figure *figure = nullptr;
    pm_vec3 center = {0.0, 0.0, 0.0};
    std::vector<std::unique_ptr<pm_orbit>> orbits;
    std::unique_ptr<pm_page_layout> layout;
    vtkNew<vtkTextActor> status, help;
    vtkNew<vtkActor2D> ring; // around what was picked
    pm_vec3 picked = {0.0, 0.0, 0.0};
    vtkRenderer *picked_in = nullptr; // NULL: nothing was
    pm_orbit *held = nullptr;         // that is dragged
    drag dragging = DRAG_NONE;
    int pressed[2] = {0, 0};
    int last[2] = {0, 0};
    bool moved = false;
};

#endif
