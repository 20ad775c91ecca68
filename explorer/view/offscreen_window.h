// A VTK render window for pictures, which needs no X server.
//
// Debian's VTK has only the X window class. With DISPLAY set that class draws off screen; without it a Mesa
// surfaceless EGL context is made here and VTK draws into its own framebuffers. Debian packages: libegl-dev
// and libglew-dev to build, libegl-mesa0 and libgl1-mesa-dri to run.
#pragma once

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

namespace cleft {

/// An off-screen window of that size in pixels, without multisampling. Throws InputError with the remedy if
/// neither an X display nor EGL is available.
vtkSmartPointer<vtkRenderWindow> make_offscreen_window(int width, int height);

/// Whether an interactive window can be opened: DISPLAY is set and an X server answers.
bool has_display();

}  // namespace cleft
