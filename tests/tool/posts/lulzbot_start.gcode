;This Gcode has been generated specifically for the LulzBot TAZ
M75
G26                          ; clear potential 'probe fail' condition
G21                          ; set units to Millimetres
M107                         ; disable fans
M420 S0                      ; disable previous leveling matrix
G90                          ; absolute positioning
M82                          ; set extruder to absolute mode
G92 E0                       ; set extruder position to 0
G28 X Y                      ; home X and Y
G1 X-17 F3000                ; clear X endstop
G1 X100 Y200 Z5
G1 Z0.43 F300
