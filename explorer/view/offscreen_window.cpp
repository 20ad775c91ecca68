#include "explorer/view/offscreen_window.h"

#include <vtkLogger.h>
#include <vtk_glew.h>  // before any other OpenGL header
// clang-format off
#include <EGL/egl.h>
#include <EGL/eglext.h>
// clang-format on
#include <X11/Xlib.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>

#include <cstdlib>
#include <string>

#include "base/error.h"

namespace cleft {
namespace {

/// A surfaceless EGL context of Mesa, current while it lives.
class EglContext {
 public:
  EglContext() {
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_display) display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr),
            "no surfaceless display");
    require(eglBindAPI(EGL_OPENGL_API), "no OpenGL");
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_PBUFFER_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_BIT,
                             EGL_RED_SIZE,
                             8,
                             EGL_GREEN_SIZE,
                             8,
                             EGL_BLUE_SIZE,
                             8,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    require(eglChooseConfig(display_, wanted, &config, 1, &found) && found > 0, "no suitable configuration");
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    require(context_ != EGL_NO_CONTEXT, "no OpenGL 3.2 context");
    make_current();
  }
  ~EglContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);  // the display is the process's: other windows may use it
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void make_current() {
    require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_), "the context is refused");
  }
  bool is_current() const { return eglGetCurrentContext() == context_; }

 private:
  static void require(bool good, const std::string& what) {
    if (!good)
      throw InputError("no picture can be drawn: DISPLAY is not set, and EGL says: " + what +
                       " (install libegl-mesa0 and libgl1-mesa-dri, or run under xvfb-run)");
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// VTK's window for a context made by somebody else, here an EglContext.
class EglWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static EglWindow* New();
  vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow)

  void MakeCurrent() override { context_.make_current(); }
  bool IsCurrent() override { return context_.is_current(); }

  /// GLEW requests a GLX display after it has loaded all of OpenGL; that there is none is harmless here.
  void OpenGLInitContext() override {
    ContextCreationTime.Modified();
    if (Initialized) return;
    const GLenum result = glewInit();
    GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
    if (!GlewInitValid || !GLEW_VERSION_3_2)
      throw InputError(
          "no picture can be drawn: OpenGL 3.2 is not available through EGL (install libgl1-mesa-dri)");
    Initialized = true;
  }

 protected:
  EglWindow() {
    SetReadyForRendering(true);
    SetSupportsOpenGL(1);
    SetIsDirect(1);
    SetOwnContext(0);
    SetMapped(1);
    SetFrameBlitModeToNoBlit();
    InitializeFromCurrentContext();
  }
  ~EglWindow() override { Finalize(); }

 private:
  EglContext context_;
};

vtkStandardNewMacro(EglWindow)

}  // namespace

bool has_display() {
  if (!std::getenv("DISPLAY")) return false;
  // VTK aborts the process where no server answers. The connection stays open: some servers (Xvfb) start anew
  // when their last client leaves, and refuse the next one meanwhile.
  static Display* const connection = XOpenDisplay(nullptr);
  return connection != nullptr;
}

vtkSmartPointer<vtkRenderWindow> make_offscreen_window(int width, int height) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // what fails is reported by us
  vtkSmartPointer<vtkRenderWindow> window;
  if (has_display())
    window = vtkSmartPointer<vtkRenderWindow>::New();
  else
    window = vtkSmartPointer<EglWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  return window;
}

}  // namespace cleft
