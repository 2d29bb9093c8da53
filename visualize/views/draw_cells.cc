// Dark cells are a breath, so that lit ones on the far side are seen through them. Cells that
// are wide are cut finer, or they would be flat.
#include "draw_cells.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <vtkCellData.h>
#include <vtkIntArray.h>

#include <cmath>

namespace {

const double lit_opacity = 0.95;
const double dark_opacity = 0.22;
const double ray_opacity = 0.5;
const uint64_t rays_most = 48;
const double patch = 2.0 * PM_PI / 64.0; // [rad] a piece is no wider

class stand {
  public:
    stand(const pm_cell_map *m, const pm_cell_place *p) : map(m), place(p)
    {
    }

    /// A distance from the axis and an azimuth, as a point of the sphere or disc.
    pm_vec3 at(double distance, double azimuth) const
    {
        double x = std::cos(azimuth);
        double y = std::sin(azimuth);
        pm_vec3 local = pm_vec(distance * x, distance * y, 0.0);
        if (map->flat == 0) {
            double aside = std::sin(distance) * place->radius;
            local = pm_vec(aside * x, aside * y, std::cos(distance) * place->radius);
        }
        return pm_vec_add(place->middle, pm_frame_to_world(&place->axis, local));
    }

    pm_vec3 way(pm_vec3 point) const
    {
        return map->flat != 0 ? place->axis.n
                              : pm_vec_normalize(pm_vec_sub(point, place->middle));
    }

  private:
    const pm_cell_map *map;
    const pm_cell_place *place;
};

int pieces(double width)
{
    return std::max(1, static_cast<int>(std::ceil(width / patch - 1e-9)));
}

void add_cell(pm_drawing *drawing, const stand &s, const pm_cell &c, bool flat)
{
    int across = flat ? 1 : pieces(c.far - c.near);
    int around = pieces(c.azimuth_end - c.azimuth);
    double r = (c.far - c.near) / across;
    double phi = (c.azimuth_end - c.azimuth) / around;
    for (int i = 0; i < across * around; i++) {
        double from = c.near + r * (i / around);
        double turn = c.azimuth + phi * (i % around);
        const pm_vec3 corner[4] = {s.at(from, turn), s.at(from, turn + phi),
                                   s.at(from + r, turn + phi), s.at(from + r, turn)};
        drawing->quad(corner, c.lit ? pm_cell_lit() : pm_cell_dark(),
                      c.lit ? lit_opacity : dark_opacity);
    }
}

void add_rays(pm_drawing *drawing, const stand &s, const pm_cell_map *map, double reach)
{
    uint64_t met = 0;
    uint64_t drawn = 0;
    uint64_t most = std::min(map->lit, rays_most);
    uint64_t count = static_cast<uint64_t>(map->rows) * map->columns;
    for (uint64_t i = 0; i < count && drawn < most; i++) {
        const pm_cell &c = map->cells[i];
        if (c.lit && met++ == drawn * map->lit / most) {
            drawn++;
            pm_vec3 from = s.at(0.5 * (c.near + c.far), 0.5 * (c.azimuth + c.azimuth_end));
            drawing->fading_line(from, pm_vec_along(from, s.way(from), reach), pm_cell_lit(),
                                 ray_opacity);
        }
    }
}

/// One polygon a cell.
vtkSmartPointer<vtkPolyData> numbers_of(const pm_cell_map *map, const stand &s)
{
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> faces;
    vtkNew<vtkIntArray> numbers[4];
    const char *const names[4] = {"light", "row", "column", "lit"};
    for (int k = 0; k < 4; k++) {
        numbers[k]->SetName(names[k]);
    }
    for (uint32_t i = 0; i < map->rows * map->columns; i++) {
        const pm_cell &c = map->cells[i];
        const pm_vec3 corner[4] = {s.at(c.near, c.azimuth), s.at(c.near, c.azimuth_end),
                                   s.at(c.far, c.azimuth_end), s.at(c.far, c.azimuth)};
        faces->InsertNextCell(4);
        for (const pm_vec3 &at : corner) {
            faces->InsertCellPoint(points->InsertNextPoint(at.x, at.y, at.z));
        }
        const uint32_t values[4] = {map->light, i / map->columns, i % map->columns, c.lit};
        for (int k = 0; k < 4; k++) {
            numbers[k]->InsertNextValue(static_cast<int>(values[k]));
        }
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(faces);
    for (const auto &array : numbers) {
        data->GetCellData()->AddArray(array);
    }
    return data;
}

} // namespace

pm_colour pm_cell_lit(void)
{
    return pm_colour_named(PM_COLOUR_YELLOW);
}

pm_colour pm_cell_dark(void)
{
    return {84, 90, 110};
}

pm_status pm_draw_cells(pm_figure *figure, const pm_cell_map *map, const pm_cell_place *place)
{
    return pm_figure_guard("cells", [&] {
        stand s(map, place);
        pm_drawing cells;
        pm_drawing rays;
        for (uint32_t i = 0; i < map->rows * map->columns; i++) {
            add_cell(&cells, s, map->cells[i], map->flat != 0);
        }
        add_rays(&rays, s, map, place->reach);
        figure->renderer->AddActor(cells.actor(1.0, 1.0));
        figure->renderer->AddActor(rays.actor(figure->pixels(1.4), 1.0));
        std::string name = std::string(map->map) + " map's cell";
        pm_figure_keep(figure, name.c_str(), numbers_of(map, s));
        return PM_OK;
    });
}
