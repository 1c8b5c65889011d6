// Draws a scene from C# by the C interface:
//   LD_LIBRARY_PATH=PREFIX/lib dotnet run -- SCENE.toml
using System;
using System.Runtime.InteropServices;

static class Look
{
    // The beginning of swell_frame: the library takes structures of fewer members.
    [StructLayout(LayoutKind.Sequential)]
    struct Frame
    {
        public nuint Size;
        public double TimeS;
        public int WidthPx, HeightPx;
        public IntPtr Camera;
        [MarshalAs(UnmanagedType.LPUTF8Str)] public string? Labels;
    }

    const string Library = "swell";
    [DllImport(Library)] static extern IntPtr swell_last_error();
    [DllImport(Library)]
    static extern int swell_world_load([MarshalAs(UnmanagedType.LPUTF8Str)] string path, out IntPtr world);
    [DllImport(Library)] static extern void swell_world_destroy(IntPtr world);
    [DllImport(Library)] static extern int swell_session_create(IntPtr world, int threads, out IntPtr session);
    [DllImport(Library)] static extern void swell_session_destroy(IntPtr session);
    [DllImport(Library)] static extern int swell_picture_create(out IntPtr picture);
    [DllImport(Library)] static extern void swell_picture_destroy(IntPtr picture);
    [DllImport(Library)] static extern int swell_render(IntPtr session, in Frame frame, IntPtr picture);
    [DllImport(Library)]
    static extern int swell_picture_copy(IntPtr picture, [MarshalAs(UnmanagedType.LPUTF8Str)] string name,
                                         float[] buffer, nuint bytes);
    [DllImport(Library)] static extern int swell_picture_hash(IntPtr picture, out ulong hash);

    static void Check(int status)
    {
        if (status != 0) throw new Exception(Marshal.PtrToStringUTF8(swell_last_error()));
    }

    static void Draw(string path)
    {
        IntPtr world = 0, session = 0, picture = 0;
        try
        {
            Check(swell_world_load(path, out world));
            Check(swell_session_create(world, 2, out session));
            Check(swell_picture_create(out picture));
            var frame = new Frame { TimeS = 5, WidthPx = 64, HeightPx = 36, Labels = "depth" };
            frame.Size = (nuint)Marshal.SizeOf<Frame>();
            Check(swell_render(session, frame, picture));
            var depthM = new float[64 * 36];
            Check(swell_picture_copy(picture, "depth", depthM, (nuint)(sizeof(float) * depthM.Length)));
            Check(swell_picture_hash(picture, out ulong hash));
            Console.WriteLine($"frame 0 xxh3 {hash:x16}");
            Console.WriteLine($"{depthM[30 * 64 + 32]:F1} m ahead");
        }
        finally
        {
            swell_picture_destroy(picture);
            swell_session_destroy(session);
            swell_world_destroy(world);
        }
    }

    static int Main(string[] arguments)
    {
        try
        {
            Draw(arguments.Length > 0 ? arguments[0] : "scenes/lagoon.toml");
            return 0;
        }
        catch (Exception fault)
        {
            Console.Error.WriteLine(fault.Message);
            return 1;
        }
    }
}
