// Dots and lines are found on the screen, where the pointer's few pixels are; faces along the
// ray behind it. Of dots that lie equally near the pointer the foremost wins.
#include "pick.hh"

#include "surface.h"

#include <vtkCamera.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <cmath>
#include <cstdio>

namespace {

const double reach = 7.0; // pixels

enum { DOTS, LINES, FACES }; // in the order in which they are tried

/// From centred space to the window, as the panel's camera sees it now.
class lens {
  public:
    explicit lens(vtkRenderer *panel)
    {
        matrix->DeepCopy(panel->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
            panel->GetTiledAspectRatio(), -1.0, 1.0));
        matrix->Invert(matrix, inverse);
        for (int i = 0; i < 2; i++) {
            origin[i] = panel->GetOrigin()[i];
            size[i] = panel->GetSize()[i];
        }
    }

    /// Pixels and depth; false behind the camera.
    bool project(const double p[3], double out[3]) const
    {
        const double in[4] = {p[0], p[1], p[2], 1.0};
        double clip[4];
        matrix->MultiplyPoint(in, clip);
        out[0] = origin[0] + 0.5 * (clip[0] / clip[3] + 1.0) * size[0];
        out[1] = origin[1] + 0.5 * (clip[1] / clip[3] + 1.0) * size[1];
        out[2] = clip[2] / clip[3];
        return clip[3] > 0.0;
    }

    pm_vec3 unproject(double x, double y, double depth) const
    {
        const double in[4] = {2.0 * (x - origin[0]) / size[0] - 1.0,
                              2.0 * (y - origin[1]) / size[1] - 1.0, depth, 1.0};
        double p[4];
        inverse->MultiplyPoint(in, p);
        return pm_vec(p[0] / p[3], p[1] / p[3], p[2] / p[3]);
    }

  private:
    vtkNew<vtkMatrix4x4> matrix, inverse;
    double origin[2], size[2];
};

/// The best so far.
struct candidate {
    const pm_dataset *dataset = nullptr;
    vtkIdType point = -1, cell = -1;
    double away = reach, depth = HUGE_VAL;
    pm_vec3 at = {0.0, 0.0, 0.0};

    void offer(const pm_dataset *from, vtkIdType a_point, vtkIdType a_cell, double distance,
               double deep, pm_vec3 where)
    {
        double whole = std::floor(distance);
        if (whole < away || (whole == away && deep < depth)) {
            *this = {from, a_point, a_cell, whole, deep, where};
        }
    }
};

pm_vec3 vector_of(const double p[3])
{
    return pm_vec(p[0], p[1], p[2]);
}

void try_dots(const pm_dataset &dataset, const lens &seen, double x, double y, candidate *best)
{
    vtkCellArray *dots = dataset.data->GetVerts();
    for (vtkIdType cell = 0; cell < dots->GetNumberOfCells(); cell++) {
        vtkIdType count;
        const vtkIdType *ids;
        dots->GetCellAtId(cell, count, ids);
        for (vtkIdType i = 0; i < count; i++) {
            double p[3];
            double s[3];
            dataset.data->GetPoint(ids[i], p);
            if (seen.project(p, s)) {
                best->offer(&dataset, ids[i], cell, std::hypot(s[0] - x, s[1] - y), s[2],
                            vector_of(p));
            }
        }
    }
}

/// The point nearest to (x, y) of a line on the screen, as a share of it.
double share_along(const double a[3], const double b[3], double x, double y)
{
    double dx = b[0] - a[0];
    double dy = b[1] - a[1];
    double length2 = dx * dx + dy * dy;
    double t = length2 > 0.0 ? ((x - a[0]) * dx + (y - a[1]) * dy) / length2 : 0.0;
    return std::fmin(std::fmax(t, 0.0), 1.0);
}

void try_lines(const pm_dataset &dataset, const lens &seen, double x, double y, candidate *best)
{
    vtkCellArray *lines = dataset.data->GetLines();
    vtkIdType first = dataset.data->GetNumberOfVerts();
    for (vtkIdType cell = 0; cell < lines->GetNumberOfCells(); cell++) {
        vtkIdType count;
        const vtkIdType *ids;
        lines->GetCellAtId(cell, count, ids);
        for (vtkIdType i = 0; i + 1 < count; i++) {
            double p[2][3];
            double s[2][3];
            dataset.data->GetPoint(ids[i], p[0]);
            dataset.data->GetPoint(ids[i + 1], p[1]);
            if (seen.project(p[0], s[0]) && seen.project(p[1], s[1])) {
                double t = share_along(s[0], s[1], x, y);
                int end = t < 0.5 ? 0 : 1;
                double away = std::hypot(s[0][0] + t * (s[1][0] - s[0][0]) - x,
                                         s[0][1] + t * (s[1][1] - s[0][1]) - y);
                best->offer(&dataset, ids[i + end], first + cell, away,
                            s[0][2] + t * (s[1][2] - s[0][2]), vector_of(p[end]));
            }
        }
    }
}

/// Faces are hit or not: the nearest along the ray wins.
void try_faces(const pm_dataset &dataset, pm_vec3 near, pm_vec3 far, candidate *best)
{
    const double from[3] = {near.x, near.y, near.z};
    const double to[3] = {far.x, far.y, far.z};
    vtkIdType first = dataset.data->GetNumberOfVerts() + dataset.data->GetNumberOfLines();
    for (vtkIdType i = 0; i < dataset.data->GetNumberOfPolys(); i++) {
        vtkCell *cell = dataset.data->GetCell(first + i);
        double t;
        double hit[3];
        double local[3];
        int part;
        if (cell->IntersectWithLine(from, to, 0.0, t, hit, local, part) != 0) {
            best->offer(&dataset, cell->GetPointId(0), first + i, 0.0, t, vector_of(hit));
        }
    }
}

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, " %.5g", value);
    return text;
}

/// "event (L 0, D 1)" tells what its numbers are called; the word of one of them, or "".
std::string word_for(const std::string &name, double value)
{
    size_t at = name.find(" (");
    char number_text[32];
    std::snprintf(number_text, sizeof number_text, " %.0f", value);
    while (at != std::string::npos && name.back() == ')') {
        size_t from = at + 2;
        size_t end = name.find_first_of(",)", from);
        std::string entry = name.substr(from, end - from);
        size_t blank = entry.rfind(' ');
        if (blank != std::string::npos && entry.substr(blank) == number_text) {
            return entry.substr(0, blank);
        }
        at = name[end] == ',' ? end : std::string::npos;
    }
    return "";
}

/// The word for a number of the array "map" in the list "map names", or "".
std::string listed_word(vtkPolyData *data, const std::string &name, double value)
{
    auto *names = vtkStringArray::SafeDownCast(
        data->GetFieldData()->GetAbstractArray((name + " names").c_str()));
    vtkIdType index = static_cast<vtkIdType>(value);
    bool listed = names != nullptr && index >= 0 && index < names->GetNumberOfValues();
    return listed ? names->GetValue(index) : "";
}

/// "power [W]" and its values as "power 1 2 3 W".
std::string tell_array(vtkPolyData *data, vtkDataArray *array, vtkIdType id)
{
    std::string name = array->GetName();
    double first = array->GetComponent(id, 0);
    std::string word = word_for(name, first) + listed_word(data, name, first);
    if (!word.empty()) {
        return ", " + name.substr(0, name.find(" (")) + " " + word;
    }
    size_t open = name.find(" [");
    bool unit = open != std::string::npos && name.back() == ']';
    std::string text = ", " + name.substr(0, unit ? open : name.size());
    for (int i = 0; i < array->GetNumberOfComponents(); i++) {
        text += number(array->GetComponent(id, i));
    }
    return unit ? text + " " + name.substr(open + 2, name.size() - open - 3) : text;
}

/// All but colours, which are seen.
std::string tell_arrays(vtkPolyData *data, vtkFieldData *fields, vtkIdType id)
{
    std::string text;
    for (int i = 0; i < fields->GetNumberOfArrays(); i++) {
        vtkDataArray *array = fields->GetArray(i);
        bool named = array != nullptr && array->GetName() != nullptr &&
                     std::string(array->GetName()) != "colour";
        if (named && id < array->GetNumberOfTuples()) {
            text += tell_array(data, array, id);
        }
    }
    return text;
}

std::string tell_place(pm_vec3 at, pm_vec3 center)
{
    pm_vec3 p = pm_vec_add(at, center);
    return " at" + number(p.x) + number(p.y) + number(p.z) + " m";
}

std::string tell(const candidate &best, pm_vec3 center)
{
    vtkPolyData *data = best.dataset->data;
    bool dot = best.cell < data->GetNumberOfVerts();
    std::string text = best.dataset->name + " " + std::to_string(dot ? best.point : best.cell) +
                       ":" + tell_place(best.at, center);
    bool of_cells = data->GetCellData()->GetNumberOfArrays() > 0;
    return text + (of_cells ? tell_arrays(data, data->GetCellData(), best.cell) : "") +
           tell_arrays(data, data->GetPointData(), best.point);
}

std::string triple(pm_vec3 v)
{
    char text[96];
    std::snprintf(text, sizeof text, "%.6g,%.6g,%.6g", v.x + 0.0, v.y + 0.0, v.z + 0.0);
    return text;
}

/// What to ask at a surface next.
pm_pick tell_surface(const pm_scene *scene, pm_vec3 from, pm_vec3 to, pm_vec3 center)
{
    pm_surface surface = {false, from, from, nullptr};
    pm_vec3 forward = pm_vec_normalize(pm_vec_sub(to, from));
    if (scene == nullptr || pm_surface_find(scene, from, forward, &surface) != PM_OK ||
        !surface.found) {
        pm_status_clear();
        return {"", from};
    }
    return {std::string(surface.id) + ":" + tell_place(surface.at, center) + "; radiance " +
                scene->path + " --at " + triple(pm_vec_add(surface.at, center)) + " --normal " +
                triple(surface.normal),
            surface.at};
}

} // namespace

pm_pick pm_pick_at(const pm_figure *figure, vtkRenderer *panel, double x, double y,
                   pm_vec3 center)
{
    lens seen(panel);
    pm_vec3 near = seen.unproject(x, y, -1.0);
    pm_vec3 far = seen.unproject(x, y, 1.0);
    candidate best;
    for (int kind = DOTS; kind <= FACES && best.dataset == nullptr; kind++) {
        for (const pm_dataset &dataset : figure->datasets) {
            if (dataset.renderer != panel) {
                continue;
            }
            switch (kind) {
            case DOTS:
                try_dots(dataset, seen, x, y, &best);
                break;
            case LINES:
                try_lines(dataset, seen, x, y, &best);
                break;
            default:
                try_faces(dataset, near, far, &best);
            }
        }
    }
    if (best.dataset == nullptr) {
        return tell_surface(figure->scene, near, far, center);
    }
    return {tell(best, center), best.at};
}
