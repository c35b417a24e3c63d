(.../pcb-gcode-3.6.2.4/pcb-gcode.ulp)
(This file generated from the board:)
(.../amp/amp.brd)
(Current profile is .../profiles/mach.pp  )
(spindle on time = 0.0000)
(milling depth = -0.0730)
(feed rate xy = F10    )
(Unit of measure: inch)
(Inch Mode)
G20
(Absolute Coordinates)
G90
S15000
G00 Z0.2500  
G00 X0.0000  Y0.0000  
M03
G04 P0.000000
G00 Z0.0500  
G00 X-0.0600 Y0.0200  
G01 Z-0.0730 F5     
G01 X-0.1100 Y-0.0300 F10    
G01 X-2.9300 Y-0.0300 
G01 X-3.0000 Y0.0400  
G00 Z0.2500  
M05
M02
