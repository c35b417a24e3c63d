G21         ; Set units to mm
G90         ; Absolute positioning
G1 Z2.54 F2540      ; Move to clearance level

;
; Operation:    0
; Name:         
; Type:         Pocket
; Paths:        1
G1 X10.5 Y10.25 F2540
; plunge
G1 Z-1 F127
; cut
G1 X20.5 Y10.25 F1016
G1 X20.5 Y20.25
G1 X10.5 Y20.25
G1 X10.5 Y10.25
; Retract
G1 Z2.54 F2540
M2
