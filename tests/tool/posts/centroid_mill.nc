; CNC code generated for Centroid CNC12
N10 G17 G40 G90 G21
N20 M25 G49 ; Goto Z home, cancel tool length offset
N30 T1 M6
N40 S1200 M3
N50 G0 X10 Y10
N60 G1 Z-1 F200
N70 M25
N80 M2
