; a macro that nobody was told to leave out
G90
PRINT_START BED_TEMP=60
G1 X10 Y10 F3000
LINE_PURGE
G1 X20
