// Turning is done about the pivot, not about the camera's focal point: the film is shifted, so
// that the scene's middle does not lie on the camera's axis. A mirrored camera mirrors the
// mouse, too.
#include "orbit.hh"

#include <vtkTransform.h>

#include <algorithm>
#include <cmath>

namespace {

/// The camera's own directions, unit.
struct directions {
    pm_vec3 right, up, forward;
};

directions directions_of(vtkCamera *camera)
{
    double f[3];
    double u[3];
    camera->GetDirectionOfProjection(f);
    camera->OrthogonalizeViewUp();
    camera->GetViewUp(u);
    pm_vec3 forward = pm_vec(f[0], f[1], f[2]);
    pm_vec3 up = pm_vec(u[0], u[1], u[2]);
    return {pm_vec_cross(forward, up), up, forward};
}

void move(vtkCamera *camera, pm_vec3 by)
{
    double p[3];
    double f[3];
    camera->GetPosition(p);
    camera->GetFocalPoint(f);
    camera->SetPosition(p[0] + by.x, p[1] + by.y, p[2] + by.z);
    camera->SetFocalPoint(f[0] + by.x, f[1] + by.y, f[2] + by.z);
}

bool is_mirrored(const pm_viewpoint &v)
{
    return pm_vec_dot(pm_vec_cross(v.forward, v.up), v.right) < 0.0;
}

} // namespace

pm_orbit::pm_orbit(const pm_panel &from) : panel(from)
{
    double bounds[6];
    panel.renderer->ComputeVisiblePropBounds(bounds);
    for (int axis = 0; axis < 3; axis++) {
        double middle = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
        pivot[axis] = bounds[0] <= bounds[1] ? middle : 0.0;
    }
    first->DeepCopy(panel.renderer->GetActiveCamera());
}

void pm_orbit::turn(double dx, double dy)
{
    vtkCamera *camera = panel.renderer->GetActiveCamera();
    directions d = directions_of(camera);
    const int *size = panel.renderer->GetSize();
    double degrees = 180.0 / std::max(1, std::min(size[0], size[1]));
    double sign = is_mirrored(panel.viewpoint) ? -1.0 : 1.0;
    vtkNew<vtkTransform> turn;
    turn->Translate(pivot);
    turn->RotateWXYZ(-sign * dx * degrees, d.up.x, d.up.y, d.up.z);
    turn->RotateWXYZ(dy * degrees, d.right.x, d.right.y, d.right.z);
    turn->Translate(-pivot[0], -pivot[1], -pivot[2]);
    camera->ApplyTransform(turn);
}

void pm_orbit::shift(double dx, double dy)
{
    vtkCamera *camera = panel.renderer->GetActiveCamera();
    directions d = directions_of(camera);
    double p[3];
    camera->GetPosition(p);
    pm_vec3 to = pm_vec(pivot[0] - p[0], pivot[1] - p[1], pivot[2] - p[2]);
    double depth = std::fabs(pm_vec_dot(to, d.forward));
    double pixel = 2.0 * depth * std::tan(camera->GetViewAngle() * PM_PI / 360.0) /
                   std::max(1, panel.renderer->GetSize()[1]);
    double sign = is_mirrored(panel.viewpoint) ? -1.0 : 1.0;
    move(camera, pm_vec_add(pm_vec_scale(d.right, -sign * dx * pixel),
                            pm_vec_scale(d.up, -dy * pixel)));
}

void pm_orbit::approach(double factor)
{
    vtkCamera *camera = panel.renderer->GetActiveCamera();
    double p[3];
    camera->GetPosition(p);
    pm_vec3 to = pm_vec(pivot[0] - p[0], pivot[1] - p[1], pivot[2] - p[2]);
    move(camera, pm_vec_scale(to, 1.0 - factor));
}

void pm_orbit::reset()
{
    panel.renderer->GetActiveCamera()->DeepCopy(first);
}

void pm_orbit::fit()
{
    const int *size = panel.renderer->GetSize();
    double aspect = static_cast<double>(size[0]) / std::max(1, size[1]);
    double tangent = std::max(panel.viewpoint.tan_y, panel.viewpoint.tan_x / aspect);
    panel.renderer->GetActiveCamera()->SetViewAngle(2.0 * std::atan(tangent) * 180.0 / PM_PI);
    panel.renderer->ResetCameraClippingRange();
}
