(Made in : Autodesk CAM Post Processor)
(G Code optimized for controller)
(OpenBuilds CNC : GRBL BlackBox)
(Post Processor : OpenbuildsFusion360PostGrbl.cps)
(Units = mm)
(Work Coordinate System : G54)
( Tool 1: Flat End Mill 2 Flutes, Diam = 3.175mm, Len = 12.00mm)
( Spindle : RPM = 10000, set router dial to 1.0)
G90
G94
G17
G21
G53 G0 Z-5
G54
G53 G0 X-5 Y-5
M3 S10000
G4 P1.8
(Operation 1 : 2D Contour1)
Z15
G0 X-4.763 Y10
Z5
G1 Z1 F333
Z-1.5
X-3.175 F1000
Y20
G2 X0 Y23.175 I3.175 J0
G1 X30
G2 X33.175 Y20 I0 J-3.175
G1 Y10
G0 Z15
M5
G53 G0 Z-5
M30
