// The water's distance along the view, where it is nearest.
out float depth;
void main() { depth = 1.0 / gl_FragCoord.w; }
