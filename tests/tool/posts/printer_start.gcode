; words that Marlin reads over
G90
M83
G28 Z P0 T140
G5
G1 X20 Y10 F3000
G28 X P0
G1 X5
