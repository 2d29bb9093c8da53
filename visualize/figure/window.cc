// The display-less path: an EGL context without a surface, lent to VTK's generic window. Up to
// VTK 9.3 that window loads OpenGL through GLEW, which reports an error for want of an X
// display after it has loaded everything; the override below accepts exactly that one. Later
// versions find EGL by themselves.
#include "window.hh"

#include "window.h"
#include "x_display.hh"

#include <vtkVersion.h>
#include <vtkVersionMacros.h>

#include <cstdlib>

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>

extern "C" unsigned glewInit(); // NOLINT(readability-identifier-naming): GLEW's

namespace {

const unsigned glew_ok = 0;
const unsigned glew_no_glx_display = 4;

class EglWindow : public vtkGenericOpenGLRenderWindow {
  public:
    static EglWindow *New();
    EglWindow(const EglWindow &) = delete;
    EglWindow &operator=(const EglWindow &) = delete;

    /// Makes a context and makes it current.
    bool begin();
    void OpenGLInitContext() override;

  protected:
    EglWindow() = default;
    ~EglWindow() override;

  private:
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
};

EglWindow *EglWindow::New()
{
    VTK_STANDARD_NEW_BODY(EglWindow);
}

EGLDisplay open_display()
{
    // Without a graphics card Mesa warns on standard error that it draws in software.
    setenv("EGL_LOG_LEVEL", "fatal", 0);
    auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    EGLDisplay display = get == nullptr
                             ? EGL_NO_DISPLAY
                             : get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    bool ready = display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) &&
                 eglBindAPI(EGL_OPENGL_API);
    return ready ? display : EGL_NO_DISPLAY;
}

bool EglWindow::begin()
{
    display = open_display();
    if (display == EGL_NO_DISPLAY) {
        return false;
    }
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                              3,
                              EGL_CONTEXT_MINOR_VERSION,
                              2,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display, wanted, &config, 1, &count);
    context = eglCreateContext(display, count > 0 ? config : nullptr, EGL_NO_CONTEXT, version);
    if (context == EGL_NO_CONTEXT ||
        !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        return false;
    }
    SetOwnContext(0);
    SetReadyForRendering(true);
    SetIsCurrent(true);
    SetSupportsOpenGL(1);
    OpenGLInitContext();
    return GlewInitValid;
}

void EglWindow::OpenGLInitContext()
{
    if (Initialized) {
        return;
    }
    unsigned result = glewInit();
    GlewInitValid = result == glew_ok || result == glew_no_glx_display;
    Initialized = GlewInitValid;
    MaximumHardwareLineWidth = 8.0f;
}

EglWindow::~EglWindow()
{
    // The display is the process's, shared by all windows: it stays open.
    if (context != EGL_NO_CONTEXT) {
        Finalize();
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }
}

vtkSmartPointer<vtkRenderWindow> open_without_display()
{
    auto window = vtkSmartPointer<EglWindow>::New();
    return window->begin() ? vtkSmartPointer<vtkRenderWindow>(window) : nullptr;
}

} // namespace

#else
namespace {

vtkSmartPointer<vtkRenderWindow> open_without_display()
{
    return vtkSmartPointer<vtkRenderWindow>::New();
}

} // namespace
#endif

namespace {

// The process's, set once, before the first window; NULL: draw without one.
void *x_display = nullptr;

} // namespace

pm_status pm_window_choose(bool on_x, bool interactive)
{
    if (!on_x && !interactive) {
        return PM_OK;
    }
    const char *option = interactive ? "--interactive" : "--display x";
    const char *instead =
        interactive ? "-o FILE draws without one" : "without --display pictures need none";
    switch (pm_x_display_open(&x_display)) {
    case PM_X_UNSET:
        return pm_status_fail(PM_EINPUT,
                              "view: %s needs an X display, and DISPLAY is not set; %s", option,
                              instead);
    case PM_X_DEAD:
        return pm_status_fail(PM_EINPUT,
                              "view: %s needs an X display, and no display answers at \"%s\"; "
                              "%s",
                              option, getenv("DISPLAY"), instead);
    case PM_X_FLAT:
        return pm_status_fail(PM_EINPUT,
                              "view: %s needs an X display with OpenGL, and \"%s\" has no GLX; "
                              "%s",
                              option, getenv("DISPLAY"), instead);
    case PM_X_READY:
        break;
    }
    return PM_OK;
}

pm_status pm_window_open(int width, int height, vtkSmartPointer<vtkRenderWindow> *window)
{
    vtkSmartPointer<vtkRenderWindow> opened =
        x_display != nullptr ? nullptr : open_without_display();
    if (opened == nullptr &&
        (x_display != nullptr || pm_x_display_open(&x_display) == PM_X_READY)) {
        opened = vtkSmartPointer<vtkRenderWindow>::New();
        opened->SetDisplayId(x_display);
    }
    if (opened == nullptr) {
        return PM_FAIL(PM_ELIMIT, "%s",
                       "no OpenGL: neither EGL without a display (packages libegl1, "
                       "libgl1-mesa-dri) nor an X display that answers");
    }
    opened->SetOffScreenRendering(1);
    opened->SetSize(width, height);
    *window = opened;
    return PM_OK;
}
