// The plotting library, which the page makes a script.
declare const Plotly: any;
