// Skin and wet wounds as they look in light, in fragment shaders of VTK's mappers; for software GL.
#pragma once

#include <vtkActor.h>

#include "haptic/pose.h"

class vtkCamera;

namespace cleft {

/// Light that enters skin leaves it beside where it entered, red the farthest: the border of light and shade
/// is soft and reddish (wrapped diffuse light, another width for each colour). Moist lips shine. The mapper's
/// data need the array SurfacePart::light.
void light_as_skin(vtkActor* actor);

/// Raw tissue under a film of liquid: highlights are small and bright.
void light_as_wound(vtkActor* actor);

/// Brushed steel, which reflects a bright sky, a horizon and a dark floor.
void light_as_steel(vtkActor* actor);

/// The shade of a scalpel near it, of actors that are lit as skin or wound; before every picture, since it is
/// in the camera's coordinates. Null: no scalpel.
void shade_under(vtkActor* actor, vtkCamera* camera, const ScalpelPose* scalpel);

}  // namespace cleft
