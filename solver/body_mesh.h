// The mesh of a body file for the solver, and how its cuts open.
#pragma once

#include "solver/body/body.h"
#include "solver/patch_mesh.h"

namespace cleft {

/// Its nodes are those of the body.
PatchMesh mesh_of(const Body& body);

/// All pairs open, in the order and the frames of the body.
Release release_of(const Body& body);

/// The parameters of a case as they are in a body: the length and the depth of its first cut, and none of the
/// shapes that a patch could have.
Parameters parameters_of(const Body& body, Parameters parameters);

/// Throws InputError, which names the option or the parameter, if a case asks for what bodies cannot do yet,
/// or what the body's regions cannot.
void check_body_case(const Body& body, const Parameters& parameters, const std::string& where);

}  // namespace cleft
