// Asked through libX11 and libGL at run time, so that a system without X needs none of them.
// No header of theirs is read: handles are void *, the few constants are GLX's.
#include "x_display.hh"

#include <cstdlib>
#include <dlfcn.h>

namespace {

const int glx_doublebuffer = 5;
const int glx_depth_size = 12;
const int glx_drawable_type = 0x8010;
const int glx_window_bit = 1;
const int glx_render_type = 0x8011;
const int glx_rgba_bit = 1;

template <class Function> Function find(void *library, const char *name)
{
    return library == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(library, name));
}

void *load(const char *name)
{
    return dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}

/// Whether VTK would find a way to draw in a window there.
bool has_opengl(void *x11, void *display)
{
    void *gl = load("libGL.so.1");
    auto query = find<int (*)(void *, int *, int *)>(gl, "glXQueryExtension");
    auto choose = find<void *(*)(void *, int, const int *, int *)>(gl, "glXChooseFBConfig");
    auto screen = find<int (*)(void *)>(x11, "XDefaultScreen");
    auto release = find<int (*)(void *)>(x11, "XFree");
    int unused[2];
    if (query == nullptr || choose == nullptr || screen == nullptr || release == nullptr ||
        query(display, &unused[0], &unused[1]) == 0) {
        return false;
    }
    const int wanted[] = {glx_drawable_type,
                          glx_window_bit,
                          glx_render_type,
                          glx_rgba_bit,
                          glx_depth_size,
                          1,
                          glx_doublebuffer,
                          1,
                          0};
    int count = 0;
    void *found = choose(display, screen(display), wanted, &count);
    if (found != nullptr) {
        release(found);
    }
    return count > 0;
}

} // namespace

pm_x_answer pm_x_display_open(void **display)
{
    if (getenv("DISPLAY") == nullptr) {
        return PM_X_UNSET;
    }
    void *x11 = load("libX11.so.6");
    auto open = find<void *(*)(const char *)>(x11, "XOpenDisplay");
    auto close = find<int (*)(void *)>(x11, "XCloseDisplay");
    void *opened = open != nullptr && close != nullptr ? open(nullptr) : nullptr;
    if (opened == nullptr) {
        return PM_X_DEAD;
    }
    if (!has_opengl(x11, opened)) {
        close(opened);
        return PM_X_FLAT;
    }
    *display = opened;
    return PM_X_READY;
}
