// The scenes that the checks open.

const CAMERA = 'camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n';
const SETTINGS = 'render { width: 32, samples: 8, output: "picture.png" }\n';

/** A scene without findings, to which a check adds its own lines; the first of those is line 4. */
export function scene(...lines) {
  return `scene 1\n${CAMERA}${SETTINGS}${lines.join('\n')}\n`;
}

export const BALL = 'sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }';

export const MATERIALS = `scene 1
/// A mirror of brass.
let brass = specular(color: #b08d57)
fn darker(color) = color * 0.5
`;

export const USER = scene(
  'import "materials.scene" as mat',
  'sphere one { center: (-1, 0, 0), radius: 0.5, material: mat.brass }',
  'sphere two { center: (1, 0, 0), radius: 0.5, material: mat.brass }',
);
