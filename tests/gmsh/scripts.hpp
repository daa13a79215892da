/**
 * @file scripts.hpp
 * Geometries for the gmsh program.
 */
#pragma once

#include <string>

/**
 * Four parallelepipeds side by side: tetrahedra, a hexahedron, prisms, and pyramids with tetrahedra (as many as n_boxes,
 * counted from the first; without prisms if that variable is 0). With `curved`, one edge of each base is an arc of a circle. In
 * two dimensions (-2), their bases: triangles and quadrilaterals.
 */
inline const std::string boxes_script = R"(
If(!Exists(curved)) curved = 0; EndIf
If(!Exists(n_boxes)) n_boxes = 4; EndIf
If(!Exists(prisms)) prisms = 1; EndIf
For i In {0:n_boxes-1}
  x = 2*i; z = curved ? 0 : 0.1;
  p = newp; Point(p) = {x,0,0}; Point(p+1) = {x+1,0.1,0}; Point(p+2) = {x+1.2,1.1,z}; Point(p+3) = {x+0.2,1,z};
  l = newl;
  If(curved)
    Point(p+4) = {x+0.6,-0.95,0}; Circle(l) = {p,p+4,p+1};
  Else
    Line(l) = {p,p+1};
  EndIf
  Line(l+1) = {p+1,p+2}; Line(l+2) = {p+2,p+3}; Line(l+3) = {p+3,p};
  c = newll; Curve Loop(c) = {l,l+1,l+2,l+3}; s = news; Plane Surface(s) = {c};
  Transfinite Curve{l,l+1,l+2,l+3} = 2; Transfinite Surface{s};
  If(i == 1 || i == 3)
    Recombine Surface{s};
  EndIf
  If(i == 0)
    Extrude {0.2,0.1,1} { Surface{s}; Layers{1}; }
  ElseIf(i == 3)
    Extrude {0.2,0.1,1} { Surface{s}; Layers{1}; Recombine; QuadTriAddVerts; }
  ElseIf(i == 1 || prisms)
    Extrude {0.2,0.1,1} { Surface{s}; Layers{1}; Recombine; }
  EndIf
EndFor
Mesh.HighOrderOptimize = 0;
)";

/** A ball of tetrahedra with names for inside and skin; the skin is also in a second group, without a name. */
inline const std::string ball_script = R"(
SetFactory("OpenCASCADE");
Sphere(1) = {0,0,0,1};
Mesh.MeshSizeMax = 0.9; Mesh.MeshSizeMin = 0.9;
Physical Volume("inside", 5) = {1};
Physical Surface("skin", 7) = {1};
Physical Surface(8) = {1};
)";

/** A quarter of a disc of triangles, with two named curves. */
inline const std::string disc_script = R"(
SetFactory("OpenCASCADE");
Disk(1) = {0,0,0,1};
Rectangle(2) = {0,0,0,2,2};
BooleanIntersection(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Mesh.MeshSizeMax = 0.5; Mesh.MeshSizeMin = 0.5;
arc[] = Curve In BoundingBox {-0.1,-0.1,-0.1,1.1,1.1,0.1};
Physical Surface("quarter") = {3};
Physical Curve("one") = {arc[0]};
Physical Curve("others") = {arc[1], arc[2]};
)";
