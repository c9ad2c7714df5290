// What adaptive_remesh's size field takes from the deformed sheet, by the terms of ARCSim's dynamicremesh.cpp
// (compute_face_sizing; read): a triangle asks for the edge length 1 / sqrt(m), where m is the largest eigenvalue of
//  - curvature: S^T S / angle^2, where S = -1/2 sum over edges of (bend angle * length * t t^T) / area, t normal to the
//    edge in the rest plane: on a cylinder edges bend by angle / sqrt(2) to angle. Edges of the border, the path and
//    incisions count as straight;
//  - compression: the positive part of -(F^T F - 1) / c^2: what a sheet that buckles with this amplitude needs;
//  - velocity: V^T V / velocity^2, V the gradient of the velocity over rest places, a spin with it: the ends of an edge
//    differ by `velocity` at most;
//  - stress: 1 / h_tip^2 times a ramp from 0 at a quarter of `stress` to 1 at `stress`, of the largest principal stress
//    (e1 + nu e2) / (1 - nu^2), e the eigenvalues of (F^T F - 1) / 2. There `stress` is refine_fracture times the
//    material's toughness.
// All are 0 in an unstrained sheet that rests in the plane z = 0, to the last bit. In a cut of a moving sheet all look
// at the sheet as it then is; a sheet that does not move has no velocity, and its stress is not known.
//
// Left out: ARCSim's second curvature, of the normals at vertices, and its share in the compression term; a share of
// bending in the stress, which is off there; obstacles and plasticity, which no scene has. The stress term is a comment
// in the copy that was read; in the whole program, as a reviewer read it, it is used where sheets tear.
#pragma once

#include "harness/mesh/sheet.h"
#include "methods/adaptive_remesh/deformed_state.h"

namespace cutbench {

/// 0: no such term.
struct DeformedTerms {
  double angle = 0.3;        ///< radians; this and the next two as in ARCSim's sphere.json. Its example of tearing has
                             ///< 0.15, five times the least length, and no term of velocity
  double compression = 0.1;  ///< c, mean rest edges: half the length at tips
  double velocity = 0.5;     ///< m/s
  double stress = 0;         ///< over Young's modulus; off, as no scene's sheet tears by itself
};

/// The angle between the deformed triangles at an edge, with a sign: 0 to pi. \pre the edge has a triangle on each side
double bend_angle(const Sheet& sheet, const DeformedState& state, HalfEdge h);

/// m of a triangle, 1 / rest unit^2. \param h, h_tip  rest units
double deformed_metric(const Sheet& sheet, const DeformedState& state, TriangleIndex t, const DeformedTerms& terms,
                       double h, double h_tip);

}  // namespace cutbench
