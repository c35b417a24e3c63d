%
(a name plate: many short moves with sharp corners, as engravers write them)
G20 G90 G17
G64 P0.0004
M3 S18000
G0 Z0.1
G55 G10 L2 P2 X0.5 Y0.5
G0 X0 Y0
G1 Z-0.01 F20
F40
(E)
G1 Y0.4
X0.25
G0 Z0.05
X0 Y0.2
G1 Z-0.01
X0.2
G0 Z0.05
X0 Y0
G1 Z-0.01
X0.25
G0 Z0.05
(S: two arcs, tangential)
G0 X0.35 Y0.1
G1 Z-0.01
G3 X0.45 Y0.2 I0.1 J0
G2 X0.35 Y0.3 I0 J0.1
G2 X0.45 Y0.4 I0.1 J0
G1 X0.6
G0 Z0.05
(a border of short chords)
G91
G0 X-0.7 Y0.1
G1 Z-0.06
X0.1 Y0.0125
X0.1 Y0.0075
X0.1 Y0.0025
X0.1 Y-0.0025
X0.1 Y-0.0075
X0.1 Y-0.0125
G90
G0 Z0.5 M5
M30
%
