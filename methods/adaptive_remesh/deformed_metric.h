// What adaptive_remesh's size field takes from the deformed sheet, by the terms of ARCSim's dynamicremesh.cpp
// (compute_face_sizing; read): a triangle asks for the edge length 1 / sqrt(m), where m is the largest eigenvalue of
//  - curvature: S^T S / angle^2, where S = -1/2 sum over edges of (bend angle * length * t t^T) / area, t normal to the
//    edge in the rest plane: edges bend by `angle` at most, on a cylinder by that over sqrt(2) and more. Edges of the
//    border, the path and incisions count as straight;
//  - compression: the positive part of -(F^T F - 1) / c^2: what a sheet that buckles with this amplitude needs.
// Both are 0 in a sheet that is flat and not compressed, to the last bit where it lies at rest.
//
// Left out: ARCSim's second curvature, of the normals at vertices, and its share in the compression term; velocity,
// obstacles and plasticity, of which a cutting method is told nothing; fracture, for which the tips stand
// (methods/adaptive_remesh/size_field.h).
#pragma once

#include "harness/mesh/sheet.h"

namespace cutbench {

struct DeformedTerms {
  double angle = 0.3;        ///< radians, as in ARCSim's examples; 0: no term of curvature
  double compression = 0.1;  ///< c, mean rest edges: half the length at tips, as in ARCSim's examples; 0: no such term
};

/// The angle between the deformed triangles at an edge, with a sign: 0 to pi. \pre the edge has a triangle on each side
double bend_angle(const Sheet& sheet, HalfEdge h);

/// m of a triangle, 1 / rest unit^2. \param c  rest units; 0: no term of compression
double deformed_metric(const Sheet& sheet, TriangleIndex t, double angle, double c);

}  // namespace cutbench
