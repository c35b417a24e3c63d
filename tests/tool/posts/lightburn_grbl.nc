; LightBurn 1.4.03
; GRBL device profile, absolute coords
; Bounds: X10 Y10 to X50 Y40
G00 G17 G40 G21 G54
G90
M4
; Cut @ 1200 mm/min, 45% power
M8
G0 X10Y10
; Layer C00
G1 X50S450F1200
G1 Y40
G1 X10
G1 Y10
M9
G0X20Y20
G2 X30I5S300F900
G1 X30Y25
M9
G1 S0
M5
G90
; return to user-defined finish pos
G0 X0 Y0
M2
