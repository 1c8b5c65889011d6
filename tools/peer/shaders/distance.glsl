// How far a surface is along the view, for what is shaded later.
out float distance_m;
void main() { distance_m = 1.0 / gl_FragCoord.w; }
