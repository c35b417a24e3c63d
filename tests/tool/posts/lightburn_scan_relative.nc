; LightBurn 1.2.00
; GRBL-M3 (1.1e or earlier) device profile, user origin
G00 G17 G40 G21 G54
G91
M3
; Scan @ 6000 mm/min, 20% power
M8
G0 X2Y2
G1 X3F6000S0
G1 X10S200
G1 X3S0
G0 Y0.1
G1 X-3S0
G1 X-10S200
G1 X-3S0
M9
G1 S0
M5
G90
; return to starting pos
G0 X0 Y0
M2
