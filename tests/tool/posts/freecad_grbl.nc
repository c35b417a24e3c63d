(Exported by FreeCAD)
(Post Processor: grbl_post)
(Output Time: 2024-03-01 10:12:00)
(Begin preamble)
G17 G90
G21
(Begin operation: Fixture)
(Path: Fixture)
G54
(Begin operation: TC: 3mm Endmill)
(Begin toolchange)
( M6 T1 )
M3 S12000
(Begin operation: Profile)
(Profile)
(Compensated Tool Path. Diameter: 3.0)
G0 Z15.000
G0 X15.851 Y-3.152
G0 Z13.000
G1 X15.851 Y-3.152 Z10.000 F120.000
G1 X15.851 Y-3.152 Z8.500 F60.000
G2 X19.957 Y-8.458 Z8.500 I-5.396 J-8.419 K0.000 F300.000
G1 X19.957 Y-20.000 Z8.500 F300.000
G2 X15.851 Y-3.152 Z7.500 I-8.000 J6.978 K0.000
G0 Z15.000
(Begin postamble)
M5
G17 G90
M2
