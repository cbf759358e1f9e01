% C: outputs are travel of the body [m], of the suspension [m], and acceleration of the body [m/s^2]
1 0 0 0
1 0 -1 0
-53.333333333333336 -3.3333333333333335 53.333333333333336 3.3333333333333335
