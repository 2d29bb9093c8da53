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

/// A shared library while it is asked.
class library {
  public:
    explicit library(const char *name) : handle(dlopen(name, RTLD_NOW | RTLD_LOCAL))
    {
    }
    library(const library &) = delete;
    library &operator=(const library &) = delete;
    ~library()
    {
        if (handle != nullptr) {
            dlclose(handle);
        }
    }

    template <class Function> Function find(const char *name) const
    {
        return handle == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(handle, name));
    }

  private:
    void *handle;
};

/// Whether VTK would find a way to draw in a window there.
bool has_opengl(const library &x11, void *display)
{
    library gl("libGL.so.1");
    auto query = gl.find<int (*)(void *, int *, int *)>("glXQueryExtension");
    auto choose = gl.find<void *(*)(void *, int, const int *, int *)>("glXChooseFBConfig");
    auto screen = x11.find<int (*)(void *)>("XDefaultScreen");
    auto release = x11.find<int (*)(void *)>("XFree");
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

pm_x_display pm_x_display_probe()
{
    if (getenv("DISPLAY") == nullptr) {
        return PM_X_UNSET;
    }
    library x11("libX11.so.6");
    auto open = x11.find<void *(*)(const char *)>("XOpenDisplay");
    auto close = x11.find<int (*)(void *)>("XCloseDisplay");
    void *display = open != nullptr && close != nullptr ? open(nullptr) : nullptr;
    if (display == nullptr) {
        return PM_X_DEAD;
    }
    pm_x_display answer = has_opengl(x11, display) ? PM_X_DRAWING : PM_X_FLAT;
    close(display);
    return answer;
}
