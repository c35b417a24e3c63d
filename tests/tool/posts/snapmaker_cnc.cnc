;Header Start
;header_type: cnc
;machine: Snapmaker A350
;gcode_flavor: marlin
;max_x(mm): 42
;max_z(mm): 20
;work_speed(mm/minute): 300
;jog_speed(mm/minute): 1500
;Header End
;Tool Path Code Start
G90
M3 P100
G0 Z20.00 F300
G0 X-2.00 Y-2.00 F1500
G0 Z1.50 F300
G1 Z-0.50 F300
G1 X42.00 Y-2.00 F300
G1 X42.00 Y12.00
G1 X-2.00 Y12.00
G1 X-2.00 Y-2.00
G1 Z-1.00 F300
G1 X42.00 Y-2.00 F300
G1 X-2.00 Y12.00
G0 Z20.00 F300
G0 X0.00 Y0.00 F1500
M5
;Tool Path Code End
