% B: inputs are the road [m] and the force of the actuator [kN], which pushes body and wheel apart
0 0
0 3.3333333333333335
0 0
3166.6666666666665 -16.666666666666668
