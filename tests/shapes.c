// Shapes by hand. Invariant: area, reach and area_below are what the scene reader would set.
#include "shapes.h"

#include <stdio.h>
#include <stdlib.h>

pm_frame pm_shapes_askew(void)
{
    return pm_frame_around(pm_vec_normalize(pm_vec(0.3, -0.7, 0.5)));
}

pm_frame pm_shapes_upright(void)
{
    return (pm_frame){{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
}

static pm_shape shape_of(pm_shape_type type)
{
    return (pm_shape){.type = type,
                      .id = "test",
                      .material = {PM_NONE, PM_NONE},
                      .light = PM_NONE,
                      .interior = PM_NONE,
                      .exterior = PM_NONE};
}

pm_shape pm_shapes_rectangle(pm_vec3 corner, pm_vec3 edge0, pm_vec3 edge1)
{
    pm_shape shape = shape_of(PM_SHAPE_RECTANGLE);
    pm_vec3 next = pm_vec_add(corner, edge0);
    double here = fmax(pm_vec_reach(corner), pm_vec_reach(next));
    double there =
        fmax(pm_vec_reach(pm_vec_add(corner, edge1)), pm_vec_reach(pm_vec_add(next, edge1)));
    shape.corner = corner;
    shape.edge[0] = edge0;
    shape.edge[1] = edge1;
    shape.area = pm_vec_length(pm_vec_cross(edge0, edge1));
    shape.reach = fmax(here, there);
    return shape;
}

pm_shape pm_shapes_sphere(pm_vec3 center, double radius)
{
    pm_shape shape = shape_of(PM_SHAPE_SPHERE);
    shape.center = center;
    shape.radius = radius;
    shape.area = 4.0 * PM_PI * radius * radius;
    shape.reach = pm_vec_reach(center) + radius;
    return shape;
}

pm_shape pm_shapes_disk(pm_vec3 center, pm_vec3 axis, double radius)
{
    pm_shape shape = shape_of(PM_SHAPE_DISK);
    shape.center = center;
    shape.axis = axis;
    shape.radius = radius;
    shape.area = PM_PI * radius * radius;
    shape.reach = pm_vec_reach(center) + radius;
    return shape;
}

pm_shape pm_shapes_cylinder(pm_vec3 center, pm_vec3 axis, double length, double radius)
{
    pm_shape shape = shape_of(PM_SHAPE_CYLINDER);
    pm_vec3 end = pm_vec_along(center, axis, length);
    shape.center = center;
    shape.axis = axis;
    shape.length = length;
    shape.radius = radius;
    shape.area = 2.0 * PM_PI * radius * length;
    shape.reach = fmax(pm_vec_reach(center), pm_vec_reach(end)) + radius;
    return shape;
}

// --- meshes ------------------------------------------------------------------------------

static void *room_for(size_t count, size_t size)
{
    void *room = calloc(count, size);
    if (!room) {
        perror("tests/shapes.c");
        abort();
    }
    return room;
}

static pm_shape mesh_of(uint32_t vertices, uint32_t triangles)
{
    pm_shape shape = shape_of(PM_SHAPE_MESH);
    shape.vertices = room_for(vertices, sizeof *shape.vertices);
    shape.triangles = room_for(triangles, sizeof *shape.triangles);
    shape.area_below = room_for(triangles, sizeof *shape.area_below);
    shape.vertex_count = vertices;
    shape.triangle_count = triangles;
    return shape;
}

static void set_triangle(pm_shape *shape, uint32_t at, uint32_t a, uint32_t b, uint32_t c)
{
    shape->triangles[at][0] = a;
    shape->triangles[at][1] = b;
    shape->triangles[at][2] = c;
}

static void measure(pm_shape *shape)
{
    shape->area = 0.0;
    shape->reach = 0.0;
    for (uint32_t i = 0; i < shape->triangle_count; i++) {
        const uint32_t *corner = shape->triangles[i];
        pm_vec3 v0 = shape->vertices[corner[0]];
        pm_vec3 edge1 = pm_vec_sub(shape->vertices[corner[1]], v0);
        pm_vec3 edge2 = pm_vec_sub(shape->vertices[corner[2]], v0);
        shape->area += 0.5 * pm_vec_length(pm_vec_cross(edge1, edge2));
        shape->area_below[i] = shape->area;
    }
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        shape->reach = fmax(shape->reach, pm_vec_reach(shape->vertices[i]));
    }
}

pm_shape pm_shapes_triangle(pm_vec3 a, pm_vec3 b, pm_vec3 c)
{
    pm_shape shape = mesh_of(3, 1);
    shape.vertices[0] = a;
    shape.vertices[1] = b;
    shape.vertices[2] = c;
    set_triangle(&shape, 0, 0, 1, 2);
    measure(&shape);
    return shape;
}

pm_shape pm_shapes_cube(const pm_frame *turned, pm_vec3 center, double half)
{
    // Vertex i stands at +half where its bits x 1, y 2, z 4 are set.
    static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                          {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                          {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    pm_shape shape = mesh_of(8, 12);
    for (int i = 0; i < 8; i++) {
        pm_vec3 local =
            pm_vec(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
        shape.vertices[i] = pm_vec_add(center, pm_frame_to_world(turned, local));
    }
    for (uint32_t i = 0; i < 12; i++) {
        set_triangle(&shape, i, faces[i][0], faces[i][1], faces[i][2]);
    }
    measure(&shape);
    return shape;
}

pm_shape pm_shapes_ball(pm_vec3 center, double radius, uint32_t rings, uint32_t sectors)
{
    // Vertices 0 and 1 are the poles, then ring after ring from the first.
    pm_shape shape = mesh_of(2 + (rings - 1) * sectors, 2 * (rings - 1) * sectors);
    shape.vertices[0] = pm_vec_add(center, pm_vec(0.0, 0.0, radius));
    shape.vertices[1] = pm_vec_add(center, pm_vec(0.0, 0.0, -radius));
    for (uint32_t i = 0; i < (rings - 1) * sectors; i++) {
        double polar = PM_PI * (1 + i / sectors) / rings;
        double turn = 2.0 * PM_PI * (i % sectors) / sectors;
        pm_vec3 unit = pm_vec(sin(polar) * cos(turn), sin(polar) * sin(turn), cos(polar));
        shape.vertices[2 + i] = pm_vec_along(center, unit, radius);
    }
    uint32_t used = 0;
    for (uint32_t i = 0; i < sectors; i++) {
        uint32_t next = (i + 1) % sectors;
        uint32_t last = 2 + (rings - 2) * sectors;
        set_triangle(&shape, used++, 0, 2 + i, 2 + next);
        set_triangle(&shape, used++, 1, last + next, last + i);
        for (uint32_t j = 0; j + 2 < rings; j++) {
            uint32_t above = 2 + j * sectors;
            uint32_t below = above + sectors;
            set_triangle(&shape, used++, above + i, below + i, below + next);
            set_triangle(&shape, used++, above + i, below + next, above + next);
        }
    }
    measure(&shape);
    return shape;
}

pm_shape pm_shapes_torus(pm_vec3 center, double ring, double tube, uint32_t around,
                         uint32_t across)
{
    pm_shape shape = mesh_of(around * across, 2 * around * across);
    for (uint32_t i = 0; i < around * across; i++) {
        double turn = 2.0 * PM_PI * (i / across) / around;
        double roll = 2.0 * PM_PI * (i % across) / across;
        double out = ring + tube * cos(roll);
        pm_vec3 local = pm_vec(out * cos(turn), out * sin(turn), tube * sin(roll));
        shape.vertices[i] = pm_vec_add(center, local);

        uint32_t here = i / across * across;
        uint32_t next = (here + across) % (around * across);
        uint32_t low = i % across;
        uint32_t high = (low + 1) % across;
        set_triangle(&shape, 2 * i, here + low, next + low, next + high);
        set_triangle(&shape, 2 * i + 1, here + low, next + high, here + high);
    }
    measure(&shape);
    return shape;
}

void pm_shapes_free(pm_shape *shapes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        free(shapes[i].vertices);
        free(shapes[i].triangles);
        free(shapes[i].area_below);
    }
}

// --- scenes ------------------------------------------------------------------------------

void pm_shapes_room(const pm_frame *turned, pm_vec3 center, double half, pm_shape walls[6])
{
    const pm_vec3 axes[3] = {turned->s, turned->t, turned->n};
    for (int i = 0; i < 6; i++) {
        double side = i % 2 ? 1.0 : -1.0;
        pm_vec3 out = axes[i / 2];
        pm_vec3 first = pm_vec_scale(axes[(i / 2 + 1) % 3], 2.0 * half);
        pm_vec3 second = pm_vec_scale(axes[(i / 2 + 2) % 3], 2.0 * half);
        pm_vec3 corner = pm_vec_along(center, out, side * half);
        corner = pm_vec_along(pm_vec_along(corner, first, -0.5), second, -0.5);
        // first x second points along `out`; inward is against it on the + side.
        walls[i] = side < 0.0 ? pm_shapes_rectangle(corner, first, second)
                              : pm_shapes_rectangle(corner, second, first);
    }
}

void pm_shapes_each(uint64_t seed, pm_shape shapes[PM_SHAPES_KINDS])
{
    pm_rng rng = pm_shapes_rng(seed, 2);
    pm_vec3 a = pm_shapes_inside(&rng, 1.0);
    pm_vec3 b = pm_shapes_inside(&rng, 1.0);
    pm_vec3 c = pm_shapes_inside(&rng, 1.0);
    pm_vec3 axis = pm_shapes_direction(&rng);
    double radius = 0.2 + 0.8 * pm_rng_draw(&rng);
    double length = 0.2 + 0.8 * pm_rng_draw(&rng);
    shapes[0] = pm_shapes_rectangle(a, pm_vec_sub(b, a), pm_vec_sub(c, a));
    shapes[1] = pm_shapes_sphere(a, radius);
    shapes[2] = pm_shapes_disk(b, axis, radius);
    shapes[3] = pm_shapes_cylinder(c, axis, length, radius);
    shapes[4] = pm_shapes_triangle(a, b, c);
}

pm_scene pm_shapes_scene(pm_shape *shapes, size_t count)
{
    return (pm_scene){
        .path = "test", .shapes = shapes, .shape_count = (int)count, .radius = 1.0};
}

pm_shape pm_shapes_scaled(const pm_shape *shape, double factor)
{
    pm_shape copy = *shape;
    copy.corner = pm_vec_scale(shape->corner, factor);
    copy.edge[0] = pm_vec_scale(shape->edge[0], factor);
    copy.edge[1] = pm_vec_scale(shape->edge[1], factor);
    copy.center = pm_vec_scale(shape->center, factor);
    copy.radius *= factor;
    copy.length *= factor;
    copy.area *= factor * factor;
    copy.reach *= factor;
    if (shape->type != PM_SHAPE_MESH) {
        return copy;
    }
    pm_shape mesh = mesh_of(shape->vertex_count, shape->triangle_count);
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        mesh.vertices[i] = pm_vec_scale(shape->vertices[i], factor);
    }
    for (uint32_t i = 0; i < shape->triangle_count; i++) {
        const uint32_t *corner = shape->triangles[i];
        set_triangle(&mesh, i, corner[0], corner[1], corner[2]);
    }
    measure(&mesh);
    return mesh;
}

pm_rng pm_shapes_rng(uint64_t index, uint32_t bounce)
{
    pm_rng_source source = {.seed = 1, .stream = PM_STREAM_TEST};
    return pm_rng_at(&source, index, bounce);
}

pm_vec3 pm_shapes_direction(pm_rng *rng)
{
    double z = 1.0 - 2.0 * pm_rng_draw(rng);
    double turn = 2.0 * PM_PI * pm_rng_draw(rng);
    double across = sqrt(fmax(0.0, 1.0 - z * z));
    return pm_vec(across * cos(turn), across * sin(turn), z);
}

pm_vec3 pm_shapes_inside(pm_rng *rng, double half)
{
    double x = half * (2.0 * pm_rng_draw(rng) - 1.0);
    double y = half * (2.0 * pm_rng_draw(rng) - 1.0);
    double z = half * (2.0 * pm_rng_draw(rng) - 1.0);
    return pm_vec(x, y, z);
}
