// Shapes are made with the linear part of to_world alone; where its origin lies is kept apart
// in shape_origin. So a scene that stands far away loses nothing before it is recentred.
//
// A rectangle's and a cube's normal is turned as normals are: a mirroring to_world leaves a
// cube's outside outside. A mirrored sphere and a mirrored mesh are turned inside out.
// (Mitsuba's rules.)
#include "mesh.h"
#include "scene_build.h"
#include "scene_value.h"

#include <math.h>
#include <string.h>

/// Lengths and angles that may differ by rounding of what the file says.
#define ALIKE 1e-6

static bool is_alike(double a, double b)
{
    return fabs(a - b) <= ALIKE * fmax(fabs(a), fabs(b));
}

static bool is_square(pm_vec3 a, pm_vec3 b)
{
    return fabs(pm_vec_dot(a, b)) <= ALIKE * pm_vec_length(a) * pm_vec_length(b);
}

static bool is_mirrored(const pm_transform *to_world)
{
    return pm_transform_handedness(to_world) < 0.0;
}

static void build_rectangle(const pm_transform *to_world, pm_shape *shape)
{
    shape->type = PM_SHAPE_RECTANGLE;
    shape->corner = pm_transform_vector(to_world, pm_vec(-1.0, -1.0, 0.0));
    shape->edge[0] = pm_vec_scale(to_world->column[0], 2.0);
    shape->edge[1] = pm_vec_scale(to_world->column[1], 2.0);
    shape->flipped ^= is_mirrored(to_world);
    shape->area = pm_vec_length(pm_vec_cross(shape->edge[0], shape->edge[1]));
}

static void build_disk(pm_scene_file *source, const pm_xml *element,
                       const pm_transform *to_world, pm_shape *shape)
{
    pm_vec3 x = to_world->column[0];
    pm_vec3 y = to_world->column[1];
    shape->type = PM_SHAPE_DISK;
    shape->radius = pm_vec_length(x);
    shape->axis = pm_vec_normalize(pm_vec_cross(x, y));
    if (is_mirrored(to_world)) {
        shape->axis = pm_vec_negate(shape->axis);
    }
    shape->area = PM_PI * shape->radius * shape->radius;
    if (!is_alike(shape->radius, pm_vec_length(y)) || !is_square(x, y)) {
        PM_FAULT(source, element, "to_world must keep a disk round: scale x and y alike");
    }
}

static void build_sphere(pm_scene_file *source, const pm_xml *element,
                         const pm_transform *to_world, pm_shape *shape)
{
    const pm_vec3 *column = to_world->column;
    pm_vec3 center = pm_scene_value_triple(source, element, "center", pm_vec(0.0, 0.0, 0.0));
    double scale = pm_vec_length(column[0]);
    shape->type = PM_SHAPE_SPHERE;
    shape->center = pm_transform_vector(to_world, center);
    shape->radius = pm_scene_value_positive(source, element, "radius", 1.0) * scale;
    shape->flipped ^= is_mirrored(to_world);
    shape->area = 4.0 * PM_PI * shape->radius * shape->radius;
    if (!is_alike(scale, pm_vec_length(column[1])) ||
        !is_alike(scale, pm_vec_length(column[2])) || !is_square(column[0], column[1]) ||
        !is_square(column[1], column[2]) || !is_square(column[2], column[0])) {
        PM_FAULT(source, element, "to_world must keep a sphere round: scale x, y and z alike");
    }
}

/// How much longer the image of a vector across the unit `axis` is, alike in all directions;
/// a fault otherwise.
static double scale_across(pm_scene_file *source, const pm_xml *element,
                           const pm_transform *to_world, pm_vec3 axis)
{
    pm_frame frame = pm_frame_around(axis);
    pm_vec3 s = pm_transform_vector(to_world, frame.s);
    pm_vec3 t = pm_transform_vector(to_world, frame.t);
    pm_vec3 n = pm_transform_vector(to_world, frame.n);
    if (!is_alike(pm_vec_length(s), pm_vec_length(t)) || !is_square(s, t) || !is_square(s, n) ||
        !is_square(t, n)) {
        PM_FAULT(source, element,
                 "to_world must keep a cylinder round: scale alike across its axis");
    } else if (is_mirrored(to_world)) {
        PM_FAULT(source, element,
                 "to_world mirrors a cylinder, whose inside is then ambiguous (Mitsuba's too): "
                 "place it by p0, p1 and radius");
    }
    return pm_vec_length(s);
}

static void build_cylinder(pm_scene_file *source, const pm_xml *element,
                           const pm_transform *to_world, pm_shape *shape)
{
    pm_vec3 p0 = pm_scene_value_triple(source, element, "p0", pm_vec(0.0, 0.0, 0.0));
    pm_vec3 p1 = pm_scene_value_triple(source, element, "p1", pm_vec(0.0, 0.0, 1.0));
    double radius = pm_scene_value_positive(source, element, "radius", 1.0);
    pm_vec3 along = pm_vec_sub(p1, p0);
    shape->type = PM_SHAPE_CYLINDER;
    if (pm_vec_reach(along) == 0.0) {
        PM_FAULT(source, element, "cylinder p0 and p1 must differ");
        along = pm_vec(0.0, 0.0, 1.0);
    }
    shape->radius = radius * scale_across(source, element, to_world, pm_vec_normalize(along));
    along = pm_transform_vector(to_world, along);
    shape->center = pm_transform_vector(to_world, p0);
    shape->length = pm_vec_length(along);
    shape->axis = pm_vec_normalize(along);
    shape->area = 2.0 * PM_PI * shape->radius * shape->length;
}

static double triangle_area(const pm_shape *shape, uint32_t i)
{
    const uint32_t *corner = shape->triangles[i];
    const pm_vec3 *v = shape->vertices;
    return 0.5 * pm_vec_length(pm_vec_cross(pm_vec_sub(v[corner[1]], v[corner[0]]),
                                            pm_vec_sub(v[corner[2]], v[corner[0]])));
}

/// Places the mesh and sums up its area.
static void place_mesh(const pm_transform *to_world, pm_shape *shape)
{
    shape->type = PM_SHAPE_MESH;
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        shape->vertices[i] = pm_transform_vector(to_world, shape->vertices[i]);
    }
    for (uint32_t i = 0; i < shape->triangle_count; i++) {
        shape->area += triangle_area(shape, i);
    }
}

static void build_cube(pm_scene_file *source, const pm_transform *to_world, pm_shape *shape)
{
    // Corner number b has x, y, z from the bits 0, 1, 2 of b; counterclockwise from outside.
    static const uint32_t faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                          {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                          {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    shape->vertices = pm_scene_file_take(source, 8, sizeof *shape->vertices);
    shape->triangles = pm_scene_file_take(source, 12, sizeof *shape->triangles);
    if (shape->vertices == NULL || shape->triangles == NULL) {
        return;
    }
    memcpy(shape->triangles, faces, sizeof faces);
    for (int b = 0; b < 8; b++) {
        shape->vertices[b] = pm_vec(b & 1 ? 1.0 : -1.0, b & 2 ? 1.0 : -1.0, b & 4 ? 1.0 : -1.0);
    }
    shape->vertex_count = 8;
    shape->triangle_count = 12;
    shape->flipped ^= is_mirrored(to_world);
    place_mesh(to_world, shape);
}

static void build_mesh(pm_scene_file *source, const pm_xml *element, pm_mesh_format format,
                       const pm_transform *to_world, pm_shape *shape)
{
    const char *name = pm_scene_value_text(element, "filename", NULL);
    shape->type = PM_SHAPE_MESH;
    if (!pm_scene_value_switch(source, element, "face_normals", false)) {
        PM_FAULT(
            source, element,
            "smooth vertex normals are not modelled, and without face_normals Mitsuba makes "
            "them: write <boolean name=\"face_normals\" value=\"true\"/>");
    }
    if (name == NULL) {
        return;
    }
    const pm_xml *at = pm_scene_value_find(element, "filename");
    const char *path = pm_xml_beside(&source->tree, element->file, name);
    char reason[PM_MESH_REASON] = "";
    pm_mesh mesh = {0};
    pm_status status =
        path == NULL ? PM_ENOMEM : pm_mesh_read(path, format, source->arena, &mesh, reason);
    if (status == PM_ENOMEM) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
    } else if (status != PM_OK) {
        PM_FAULT(source, at, "mesh \"%.120s\" %s", path, reason);
    }
    shape->vertices = mesh.vertices;
    shape->triangles = mesh.triangles;
    shape->vertex_count = mesh.vertex_count;
    shape->triangle_count = mesh.triangle_count;
    // A mirrored mesh keeps its winding, so its normals turn by themselves.
    place_mesh(to_world, shape);
}

/// False when nothing could be built.
static bool build_geometry(pm_scene_file *source, const pm_xml *element, const char *type,
                           const pm_transform *to_world, pm_shape *shape)
{
    if (strcmp(type, "rectangle") == 0) {
        build_rectangle(to_world, shape);
    } else if (strcmp(type, "cube") == 0) {
        build_cube(source, to_world, shape);
    } else if (strcmp(type, "sphere") == 0) {
        build_sphere(source, element, to_world, shape);
    } else if (strcmp(type, "disk") == 0) {
        build_disk(source, element, to_world, shape);
    } else if (strcmp(type, "cylinder") == 0) {
        build_cylinder(source, element, to_world, shape);
    } else if (strcmp(type, "ply") == 0) {
        build_mesh(source, element, PM_MESH_PLY, to_world, shape);
    } else if (strcmp(type, "obj") == 0) {
        build_mesh(source, element, PM_MESH_OBJ, to_world, shape);
    } else {
        return false;
    }
    return true;
}

static void check_area(pm_scene_file *source, const pm_xml *element, const pm_shape *shape)
{
    if (!(shape->area > 0.0) || !isfinite(shape->area)) {
        PM_FAULT(source, element, "%s must have an area that is > 0 and finite, got %g m^2",
                 pm_xml_attribute(element, "type"), shape->area);
    }
}

static void build_shape(pm_scene_file *source, const pm_xml *element, int index)
{
    pm_shape *shape = &source->scene.shapes[index];
    const char *type = pm_xml_attribute(element, "type");
    *shape = (pm_shape){
        .line = element->line, .light = PM_NONE, .interior = PM_NONE, .exterior = PM_NONE};
    pm_scene_build_sides(source, element, shape->material);
    pm_scene_build_boundary(source, element, shape);
    if (type == NULL) {
        return;
    }
    int before = source->faults.count;
    shape->id = pm_scene_file_name(source, element);
    shape->flipped = pm_scene_value_switch(source, element, "flip_normals", false);
    pm_transform to_world = pm_scene_value_transform(source, element, "to_world");
    source->shape_origin[index] = to_world.origin;
    bool built = build_geometry(source, element, type, &to_world, shape);
    bool whole = shape->type != PM_SHAPE_MESH || shape->triangle_count > 0;
    if (built && whole && source->faults.count == before) {
        check_area(source, element, shape);
    }
}

void pm_scene_build_shapes(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    size_t count = (size_t)pm_scene_file_count(source, "shape");
    scene->shapes = pm_scene_file_take(source, count, sizeof *scene->shapes);
    source->shape_origin = pm_arena_take(&source->tree, count, sizeof *source->shape_origin);
    if (scene->shapes == NULL || source->shape_origin == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    for (pm_xml *e = source->root->child; e != NULL; e = e->next) {
        if (strcmp(e->tag, "shape") == 0) {
            e->index = scene->shape_count++;
            build_shape(source, e, e->index);
        }
    }
}
