;FLAVOR:Marlin
;TIME:1023
;Filament used: 0.7m
;Layer height: 0.2
;MINX:90
;Generated with Cura_SteamEngine 5.2.1
M140 S60
M105
M190 S60
M104 S200
M105
M109 S200
M82 ;absolute extrusion mode
M201 X500.00 Y500.00 Z100.00 E5000.00 ;Setup machine max acceleration
M220 S100 ;Reset Feedrate
M221 S100 ;Reset Flowrate
G28 ;Home
G92 E0 ;Reset Extruder
G1 Z2.0 F3000 ;Move Z Axis up
G1 X10.1 Y20 Z0.28 F5000.0 ;Move to start position
G1 X10.1 Y200.0 Z0.28 F1500.0 E15 ;Draw the first line
G92 E0
G1 F2700 E-5
;LAYER_COUNT:1
;LAYER:0
M107
G0 F6000 X97.2 Y102.7 Z0.2
;TYPE:WALL-INNER
G1 F2700 E0
G1 F1200 X98.1 Y101.9 E0.0399
G1 X120.0 Y101.9 E0.7684
G1 X120.0 Y120.0 E1.3705
M140 S0
M107
G91 ;Relative positioning
G1 E-2 F2700 ;Retract a bit
G1 Z10 ;Raise Z more
G90 ;Absolute positioning
G1 X0 Y220 ;Present print
M106 S0 ;Turn-off fan
M104 S0 ;Turn-off hotend
M84 X Y E ;Disable all steppers but Z
M82 ;absolute extrusion mode
;End of Gcode
