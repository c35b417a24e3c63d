( Made using CamBam - http://www.cambam.co.uk )
( plate 3/4/2021 9:15:02 PM )
( T1 : 3.0 )
G21 G90 G64 G40
G0 Z3.0
( T1 : 3.0 )
T1 M6
( Profile1 )
G17
M3 S1000
G0 X-1.5 Y0.0
G0 Z1.0
G1 F300.0 Z-0.5
G1 F800.0 Y30.0
G2 X0.0 Y31.5 I1.5 J0.0
G1 X40.0
G2 X41.5 Y30.0 I0.0 J-1.5
/G1 X60.0
/o100 if [1 EQ 1]
/G1 Y10.0
/o100 endif
G1 Y0.0
G0 Z3.0
M5
M30
