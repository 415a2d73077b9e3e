0 BEGIN PGM BLADE MM 1;
PART blade.step 2;
MACHINE sample 3;
TOOL 3 BARREL 10 4;
TOOL DIAMETER 10.0 LENGTH 62.5 TIP OFFSET 2.25 5 TOOL CALL 3 Z S5000 6 CYCL DEF 247 Q339 =
    1 7 CYCL DEF 32.0 TOLERANCE 8 CYCL DEF 32.1 T0,
                                                                                    02 9 CYCL DEF 32.2 HSC -
                                                                                        MODE : 0 TA0,
                                                                                    05 10 M3 11 M126 12 L A - 30,
                                                                                    0 C + 45,
                                                                                    0 R0 FMAX 13 M128 14 L X + 10,
                                                                                    0 Y - 20, 0 Z + 80, 0 A - 30,
                                                                                    0 C + 45, 0 FMAX 15;
STRIP 1 flank F1 16 L X + 10, 0 Y - 20, 0 Z + 12, 5 A - 30, 0 C + 45, 0 F800 17 L X + 12, 0625 Y - 18, 0 Z + 12,
    25 A - 29, 5 C + 47, 12345 18 L X + 14, 0 Y - 16, 0 Z + 12, 0 A + 0, 0 C + 50, 0 F1200 19;
END OF STRIP 20 L X + 14, 0 Y - 16, 0 Z + 80, 0 A + 0, 0 C + 50, 0 FMAX 21;
STRIP 2 flank F1, F3 22 L X - 5, 0 Y + 0, 0 Z + 80, 0 A + 0, 0 C - 360, 0 FMAX 23 L X - 5, 5 Y + 0, 0001 Z - 0, 5 A + 0,
    5 C - 361, 0 24 M129 25 L M140 MB MAX FMAX 26 M5 27 M30 28 END PGM BLADE MM
