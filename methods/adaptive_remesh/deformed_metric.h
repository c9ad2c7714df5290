// What adaptive_remesh's size field takes from the deformed sheet, by the terms of ARCSim's dynamicremesh.cpp
// (compute_face_sizing; read): a triangle asks for the edge length 1 / sqrt(m), where m is the largest eigenvalue of
//  - curvature: S^T S / angle^2, where S = -1/2 sum over edges of (bend angle * length * t t^T) / area, t normal to the
//    edge in the rest plane: edges bend by `angle` at most, on a cylinder by that over sqrt(2) and more. Edges of the
//    border, the path and incisions count as straight;
//  - compression: the positive part of -(F^T F - 1) / c^2: what a sheet that buckles with this amplitude needs;
//  - velocity: V^T V / velocity^2, V the gradient of the velocity over rest places: the ends of an edge differ by
//    `velocity` at most;
//  - stress: 1 / h_tip^2 times a ramp from 0 at a quarter of `stress` to 1 at `stress`, of the largest principal stress
//    (e1 + nu e2) / (1 - nu^2), e the eigenvalues of (F^T F - 1) / 2: fine where a sheet of that toughness would tear
//    next.
// All are 0 in a sheet that is flat, unstrained and at rest, to the last bit. In a cut of a moving sheet all look at
// the sheet as it then is; a sheet that does not move has no velocity, and its stress is not known.
//
// Left out: ARCSim's second curvature, of the normals at vertices, and its share in the compression term; obstacles and
// plasticity, which no scene has. Its stress term is a comment in the copy that was read; there the stress is that of
// the triangle and its neighbours, over the material's toughness.
#pragma once

#include "harness/mesh/sheet.h"
#include "methods/adaptive_remesh/deformed_state.h"

namespace cutbench {

/// 0: no such term.
struct DeformedTerms {
  double angle = 0.3;        ///< radians, as in ARCSim's examples
  double compression = 0.1;  ///< c, mean rest edges: half the length at tips, as in ARCSim's examples
  double velocity = 0.5;     ///< m/s, as in ARCSim's examples
  double stress = 0;         ///< over Young's modulus; off, as no scene's sheet tears by itself
};

/// The angle between the deformed triangles at an edge, with a sign: 0 to pi. \pre the edge has a triangle on each side
double bend_angle(const Sheet& sheet, const DeformedState& state, HalfEdge h);

/// m of a triangle, 1 / rest unit^2. \param h, h_tip  rest units
double deformed_metric(const Sheet& sheet, const DeformedState& state, TriangleIndex t, const DeformedTerms& terms,
                       double h, double h_tip);

}  // namespace cutbench
